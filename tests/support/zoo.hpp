#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

namespace lutka::test {

/// Whether the folder of real models is there; where it is absent a word is printed and the test returns.
inline bool zooIsThere() {
    if (std::filesystem::is_directory(LUTKA_ZOO_DIR)) return true;
    std::printf("skipped: the folder of test models %s is not there\n", LUTKA_ZOO_DIR);
    return false;
}

inline std::filesystem::path zooFile(const std::string& relative) {
    return std::filesystem::path(LUTKA_ZOO_DIR) / relative;
}

}  // namespace lutka::test
