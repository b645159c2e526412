#pragma once

#include <filesystem>
#include <span>

#include "render/camera.hpp"
#include "render/image.hpp"

namespace lutka::editor {

/// $XDG_CACHE_HOME/lutka/models, or the same in ~/.cache: where small pictures of opened models are kept. Empty when
/// neither variable is set.
[[nodiscard]] std::filesystem::path modelPictureFolder();

/// The file in `folder` of a model's picture; models of the same name elsewhere have others.
[[nodiscard]] std::filesystem::path modelPictureFile(const std::filesystem::path& folder,
                                                     const std::filesystem::path& model);

/// What lies around the part of a picture in which these points are seen, with some room; nothing when none is seen.
[[nodiscard]] render::PictureInsets insetsAround(std::span<const vec3> points, const render::Camera& camera,
                                                 render::Extent window);

/// The part of the view within the insets as a picture of that size. Where the part has other proportions more of the
/// view is shown beside or above it; what the view does not have is left out.
[[nodiscard]] render::Image smallPicture(const render::Image& view, const render::PictureInsets& around,
                                         render::Extent size);

}  // namespace lutka::editor
