#pragma once

#include <filesystem>
#include <string>

#include "support/skip.hpp"

namespace lutka::test {

inline std::filesystem::path zooFile(const std::string& relative) {
    return std::filesystem::path(LUTKA_ZOO_DIR) / relative;
}

}  // namespace lutka::test

/// Skips the test case where the folder of real models is not there.
#define NEEDS_ZOO()                                    \
    if (!std::filesystem::is_directory(LUTKA_ZOO_DIR)) \
    SKIP_TEST("the folder of test models %s is not there", LUTKA_ZOO_DIR)
