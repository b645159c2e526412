#pragma once

#include <cstddef>

namespace lutka {

/// Bytes of memory that the process holds in RAM (its resident set); 0 where the system does not tell.
[[nodiscard]] std::size_t residentBytes();

}  // namespace lutka
