#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "animation/import/model_folder.hpp"

namespace lutka::animation::rig_import {

/// What a reader asked for and did not get: files, by the names it asked with. And what a Collada document is that it
/// got otherwise than it is written.
struct LeftOut {
    std::set<std::string> outside;                   ///< Of the model's folder.
    std::set<std::string> absent;                    ///< Not there.
    std::vector<std::string> warnings;               ///< What is lost of a Collada document, a sentence each.
    std::map<std::string, std::string> nodeNames{};  ///< SettledCollada::names
};

/// Assimp's door to the disk: opens the model and the ordinary files that its folder admits, for reading, up to
/// kMaxFileBytes each; a Collada document as the functions of collada_*.hpp leave it, a B3D file as tidyB3d(), a
/// material script of Ogre as tidyOgreMaterial(). Whatever else a format names (a material library, an
/// animation, a skin) is not there for it.
class ConfinedFiles : public Assimp::DefaultIOSystem {
  public:
    /// `leftOut` is filled as files are asked for.
    ConfinedFiles(std::filesystem::path model, ModelFolder folder, std::shared_ptr<LeftOut> leftOut);

    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    bool CreateDirectory(const std::string& path) override;
    bool DeleteFile(const std::string& file) override;

  private:
    [[nodiscard]] bool mayOpen(const std::string& file) const;
    [[nodiscard]] Assimp::IOStream* openTidied();
    [[nodiscard]] static Assimp::IOStream* openMaterial(const std::string& file);

    std::filesystem::path model_;
    ModelFolder folder_;
    std::shared_ptr<LeftOut> leftOut_;
    std::optional<std::string> tidied_;  // of the model, once it was looked at
};

}  // namespace lutka::animation::rig_import
