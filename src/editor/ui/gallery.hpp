#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "render/gl/shown_picture.hpp"

namespace lutka::editor {

/// The pictures of recent models, read when they are first shown. Needs the GL context current.
class PictureShelf {
  public:
    /// Null: there is none.
    [[nodiscard]] const render::ShownPicture* find(const std::filesystem::path& file);
    /// It was written anew.
    void forget(const std::filesystem::path& file) { pictures_.erase(file); }

  private:
    std::map<std::filesystem::path, std::optional<render::ShownPicture>> pictures_;
};

}  // namespace lutka::editor
