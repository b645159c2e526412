#pragma once

#include <string>

#include "core/result.hpp"
#include "render/image.hpp"

namespace lutka::render {

/// The picture as a PNG file's bytes; fails with ErrorCode::internal.
[[nodiscard]] Result<std::string> pngBytes(const Image& image);

}  // namespace lutka::render
