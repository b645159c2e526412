#pragma once

#include <memory>

#include "render/image.hpp"

namespace lutka::render {

/// A picture as a GL texture, for panels that show it. The context must be current whenever one is made or dies.
class ShownPicture {
  public:
    explicit ShownPicture(const Image& image);
    ShownPicture(ShownPicture&&) noexcept;
    ShownPicture& operator=(ShownPicture&&) noexcept;
    ~ShownPicture();

    /// GL's name of it; rows run from the top.
    [[nodiscard]] unsigned int texture() const;
    [[nodiscard]] Extent size() const { return size_; }

  private:
    struct State;
    std::unique_ptr<State> state_;
    Extent size_;
};

}  // namespace lutka::render
