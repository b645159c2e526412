#pragma once

#include <cstdio>

/// Ends the test case as skipped: CTest reports it so by the printed line (lutka_test() in cmake/LutkaTargets.cmake),
/// and `tools/test` fails over it in CI. For what a machine may lack, never for what failed. Not below a section's
/// check.
#define SKIP_TEST(...)                                   \
    do {                                                 \
        std::printf("lutka-test-skipped: " __VA_ARGS__); \
        std::printf("\n");                               \
        return;                                          \
    } while (false)
