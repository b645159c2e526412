#pragma once

#include <cstddef>
#include <cstdint>

#include "animation/character.hpp"

namespace lutka::fuzz {

/// Takes numbers from a fuzzer's bytes; zeros when they are used up.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    [[nodiscard]] bool empty() const { return left_ == 0; }
    int next() {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }
    /// In [-most, most], in 256 steps.
    float spread(float most) { return most * (static_cast<float>(next()) - 127.5F) / 127.5F; }

  private:
    const std::uint8_t* data_;
    std::size_t left_;
};

/// A figure as import could give it: a tree of joints in any shape and with any names, and boxes that follow them. The
/// first byte says whether it begins as the hand-made biped, whose joints the other bytes then move, rename and hang
/// elsewhere.
[[nodiscard]] animation::Character figureFrom(Bytes& bytes);

}  // namespace lutka::fuzz
