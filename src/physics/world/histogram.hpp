#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace lutka::physics {

namespace detail {
inline constexpr unsigned kShift = 16;  // bits of a float that a bin does not tell apart
constexpr int binOf(float value) {
    return static_cast<int>(std::bit_cast<std::uint32_t>(value) >> kShift);
}
constexpr float middleOf(int bin) {
    return std::bit_cast<float>((static_cast<std::uint32_t>(bin) << kShift) + (1U << (kShift - 1)));
}
}  // namespace detail

/// Counts values in bins that grow by less than 1 %, so that a percentile of millions of samples needs no memory. A bin
/// is a float's exponent and the first seven bits of its fraction: a logarithm for each sample cost more than measuring
/// it.
class Histogram {
  public:
    void add(float value) {
        ++count_;
        if (!(value < kHighest)) {  // so far off, or not a number, that its place no longer matters
            ++counts_[kBins - 1];
            sum_ += static_cast<double>(kHighest);
            return;
        }
        sum_ += static_cast<double>(value);
        if (value <= kLowest) {
            ++counts_[0];
            return;
        }
        ++counts_[1 + detail::binOf(value) - kFirst];
    }
    /// The value that a share of the samples does not exceed, to 1 %; 0 without samples.
    [[nodiscard]] float percentile(double share) const {
        std::int64_t below = 0;
        for (int bin = 0; bin < kBins; ++bin) {
            below += counts_[bin];
            if (count_ > 0 && static_cast<double>(below) >= share * static_cast<double>(count_))
                return bin == 0 ? 0.0F : detail::middleOf(bin - 1 + kFirst);
        }
        return 0.0F;
    }
    [[nodiscard]] float mean() const {
        return count_ > 0 ? static_cast<float>(sum_ / static_cast<double>(count_)) : 0.0F;
    }

  private:
    static constexpr float kLowest = 1e-7F;
    static constexpr float kHighest = 1e4F;
    static constexpr int kFirst = detail::binOf(kLowest);
    static constexpr int kBins = detail::binOf(kHighest) - kFirst + 2;
    std::array<std::int64_t, kBins> counts_{};
    std::int64_t count_ = 0;
    double sum_ = 0;
};

}  // namespace lutka::physics
