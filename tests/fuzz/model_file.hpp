#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::fuzz {

/// The bytes as a file in memory, for readers that take a path; it is gone with this object.
class ModelFile {
  public:
    ModelFile(const std::uint8_t* data, std::size_t size);
    ~ModelFile();
    ModelFile(const ModelFile&) = delete;
    ModelFile& operator=(const ModelFile&) = delete;
    [[nodiscard]] std::filesystem::path path() const;

  private:
    int handle_;
};

/// What happens to a scene after it is read: cleaned, taken over a pipe, built. What comes out must be a sound
/// character.
void promiseSoundImport(Result<animation::rig_import::SourceScene> scene);

}  // namespace lutka::fuzz
