#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>

/// One run of a fuzz target (https://llvm.org/docs/LibFuzzer.html): any bytes; it must return, whatever they are.
/// Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace lutka::fuzz {

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program, as a sanitizer would, with its place: what the target promises of its result does not hold.
inline void promise(bool holds, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    if (holds) return;
    std::fprintf(stderr, "%s:%d: the promise does not hold\n", file, line);
    __builtin_trap();
}

}  // namespace lutka::fuzz
