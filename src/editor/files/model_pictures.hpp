#pragma once

#include <filesystem>

#include "render/camera.hpp"
#include "render/image.hpp"

namespace lutka::editor {

/// $XDG_CACHE_HOME/lutka/models, or the same in ~/.cache: where small pictures of opened models are kept. Empty when
/// neither variable is set.
[[nodiscard]] std::filesystem::path modelPictureFolder();

/// The file in `folder` of a model's picture; models of the same name elsewhere have others.
[[nodiscard]] std::filesystem::path modelPictureFile(const std::filesystem::path& folder,
                                                     const std::filesystem::path& model);

/// The free part of the view, as a picture of that size; what does not fit its proportions is left out.
[[nodiscard]] render::Image smallPicture(const render::Image& view, const render::PictureInsets& covered,
                                         render::Extent size);

}  // namespace lutka::editor
