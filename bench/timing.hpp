#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

/// The middle one of the values, of which there is one at least.
inline double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Milliseconds on the clock that a call takes.
inline double timeOf(const std::function<void()>& run) {
    const auto before = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
}
