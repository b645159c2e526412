#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "editor/document/scene_settings.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::editor {

/// The scene that a ragdoll is edited in: its entities and settings, the assets of its other characters, its file, and
/// whether it differs from that. What it holds was prepared: it is valid and every character in it has its asset.
/// Knows no undo: who keeps that gives earlier settings back by adopt().
class SceneDocument {
  public:
    /// `edited` is the character whose ragdoll is edited; it must outlive the document.
    explicit SceneDocument(const scene::RagdollAsset& edited) : edited_(edited) {}
    SceneDocument(const SceneDocument&) = delete;
    SceneDocument& operator=(const SceneDocument&) = delete;

    /// How the edited character was opened: others are read alike, and with another profile than `profile`, or none,
    /// the same model is another character of the scene. `fit` makes the ragdolls of the others, as far as the scene
    /// says nothing of them.
    void setOrigin(const animation::ImportOptions& import, const physics::FitOptions& fit,
                   const std::filesystem::path& profile);
    /// Where the edited profile is saved, and whether it is a file by now; scenes that are saved name it then.
    void setProfileFile(const std::filesystem::path& file, bool exists);

    [[nodiscard]] const SceneSettings& settings() const { return settings_; }
    [[nodiscard]] const scene::EntityScene& scene() const { return settings_.entities; }

    /// The scene to begin with; named scenes are made when it has no entities. Fails as prepare() does; the scene is
    /// then as it was.
    [[nodiscard]] Result<void> start(SceneSettings settings);
    /// The settings as adopt() takes them: another scenario, count or seed makes the named scene's entities anew, and
    /// other characters are read. Fails with ErrorCode::usage for what no scene can have, and with ErrorCode::input
    /// when a character's files can't be read.
    [[nodiscard]] Result<SceneSettings> prepare(SceneSettings settings);
    /// The same for settings whose named scene was made before, with these entities.
    [[nodiscard]] Result<SceneSettings> prepareMade(SceneSettings settings);
    /// `settings` must have been prepared by this document.
    void adopt(SceneSettings settings);

    /// The characters of the scene: the edited one first, then those with other models or profiles.
    [[nodiscard]] std::vector<const scene::RagdollAsset*> assets() const;
    /// Which of assets() each of scene().all<Ragdoll>() is.
    [[nodiscard]] std::vector<int> assetOfRagdoll() const;
    [[nodiscard]] const scene::RagdollAsset& assetOf(const scene::Ragdoll& ragdoll) const;
    [[nodiscard]] bool isEdited(const scene::Ragdoll& ragdoll) const;

    /// Whether the scene differs from what it began with, was opened, or was saved last.
    [[nodiscard]] bool unsaved() const { return unsaved_; }
    /// Where the scene is saved: the file that was opened or saved last; beside the model else.
    [[nodiscard]] std::filesystem::path file() const;
    [[nodiscard]] bool hasFile() const { return !file_.empty(); }
    /// The scene counts as saved there (it was just read from it).
    void setFile(const std::filesystem::path& file);
    /// Takes over the file, and what counts as saved in it, of the document that this one replaces.
    void takeFileOf(const SceneDocument& old);
    /// Writes the scene without taking the file for its own. As save() else.
    [[nodiscard]] Result<void> write(const std::filesystem::path& file) const;
    /// A character without a model of its own is written with the model of the edited one, and with its profile's file
    /// where it has one.
    [[nodiscard]] Result<void> save(const std::filesystem::path& file);

  private:
    void compare();
    [[nodiscard]] Result<void> check(SceneSettings& settings);
    [[nodiscard]] Result<void> loadOthers(const scene::EntityScene& scene);
    [[nodiscard]] const std::filesystem::path& modelOf(const scene::Ragdoll& ragdoll) const;

    const scene::RagdollAsset& edited_;
    SceneSettings settings_;
    // Of the scene's other characters, by model, figure, profile and what it is taken as. Kept for undo.
    using OtherKey = std::tuple<std::filesystem::path, int, std::filesystem::path, physics::RigKind>;
    [[nodiscard]] OtherKey keyOf(const scene::Ragdoll& ragdoll) const;
    std::map<OtherKey, std::unique_ptr<scene::RagdollAsset>> others_;
    scene::LoadOptions load_;
    std::filesystem::path openedWith_;
    std::filesystem::path profileFile_;
    bool profileExists_ = false;
    std::filesystem::path file_;
    scene::EntityScene saved_;
    // The profile that the saved file names for the edited character, empty for none; unset: it was opened.
    std::optional<std::filesystem::path> savedProfile_;
    bool unsaved_ = false;
};

/// Which figure of its file a scene says that its character is, and what that is taken as; what it leaves open stays.
void takeAs(const scene::Ragdoll& character, scene::LoadOptions& load);

}  // namespace lutka::editor
