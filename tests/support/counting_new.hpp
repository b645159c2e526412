#pragma once

#include <cstddef>

namespace lutka::test {

/// How often `new` was called in this program so far. Only programs that link counting_new.cpp have it.
[[nodiscard]] std::size_t allocationCount();

}  // namespace lutka::test
