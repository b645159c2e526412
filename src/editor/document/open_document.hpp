#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "editor/document/editor_document.hpp"
#include "physics/fit/rebind.hpp"

namespace lutka::editor {

/// Documents that are to take the place of `present`, each with its scene begun. `load` tells how to read a model; the
/// profile that it names belongs to another one and is not used. All fail as EditorDocument::open() and startScene()
/// do.

/// The model of a file, in the place of the edited character in the present scene. `as`: which of the file's figures
/// it is and what it is taken as; where that says nothing, the one with most vertices, and as `load` has it.
[[nodiscard]] Result<std::unique_ptr<EditorDocument>> openModel(const std::filesystem::path& file,
                                                                const scene::LoadOptions& load,
                                                                const EditorDocument& present,
                                                                const scene::Ragdoll& as = {});
/// The same model read again, with the present one's edits, scene and files.
[[nodiscard]] Result<std::unique_ptr<EditorDocument>> reopenModel(const scene::LoadOptions& load,
                                                                  const EditorDocument& present);
/// Another character of the present scene, to be edited in it.
[[nodiscard]] Result<std::unique_ptr<EditorDocument>> openCharacter(const scene::Ragdoll& character,
                                                                    const scene::LoadOptions& load,
                                                                    const EditorDocument& present);
/// The first character of a scene that was read from `file`, in that scene; null when it is the one that `present`
/// edits, or the scene has none: then `present` can take the scene itself.
[[nodiscard]] Result<std::unique_ptr<EditorDocument>> openScene(const std::filesystem::path& file,
                                                                const scene::EntityScene& scene,
                                                                const scene::LoadOptions& load,
                                                                const EditorDocument& present);

/// A profile's file for a character; see physics::bindOrRebind().
[[nodiscard]] Result<physics::BoundProfile> profileFor(const std::filesystem::path& file,
                                                       const animation::Character& character,
                                                       const animation::HumanoidMap& map);
/// What to say of a profile that the document has just taken.
[[nodiscard]] std::string profileNews(const EditorDocument& document, const std::filesystem::path& file);

}  // namespace lutka::editor
