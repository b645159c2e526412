#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/result.hpp"
#include "editor/document_state.hpp"
#include "editor/undo_stack.hpp"
#include "physics/doctor.hpp"
#include "scene/ragdoll_asset.hpp"

namespace lutka::editor {

/// A character with the ragdoll that is being edited, and the scene it falls in. All editing goes through here: every
/// call below makes one entry of undo (or joins its group), is checked before it takes effect, and leaves everything as
/// it was when it fails. Knows no window, no UI and no running simulation.
class EditorDocument {
  public:
    /// Loads the model (and the profile of `options`, when it names one).
    [[nodiscard]] static Result<std::unique_ptr<EditorDocument>> open(const std::filesystem::path& model,
                                                                      const scene::LoadOptions& options = {});
    /// For an asset that is there already.
    explicit EditorDocument(std::unique_ptr<scene::RagdollAsset> asset);

    [[nodiscard]] const animation::Character& character() const { return asset_->character; }
    [[nodiscard]] const DocumentState& state() const { return state_; }
    [[nodiscard]] const physics::RagdollProfile& profile() const { return state_.profile; }

    /// Grows with every change of the ragdoll or the scene, undo and redo included: who runs a simulation compares.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }
    /// The asset as of the last commitAsset(), for simulations to borrow.
    [[nodiscard]] const scene::RagdollAsset& asset() const { return *asset_; }
    /// Makes asset() follow state(). No simulation may live on asset() while this is called.
    void commitAsset();

    // Mapping. Each maps the other roles anew around what the user fixed, and fits the ragdoll anew with the user's
    // other edits kept. Fails with ErrorCode::input when the result would not be a humanoid.
    [[nodiscard]] Result<void> assignRole(animation::Role role, int joint);
    [[nodiscard]] Result<void> unmapRole(animation::Role role);
    /// Gives the roles of the other side the joints that mirror those of `from` (by position across the figure).
    [[nodiscard]] Result<void> mirrorRoles(animation::Side from);
    /// Maps anew; keeps what the user fixed unless `forgetFixed`.
    [[nodiscard]] Result<void> mapAgain(bool forgetFixed);

    // Bodies and constraints; indices into profile(). `group`: see UndoStack. Fail with ErrorCode::usage, naming all
    // that validate() finds, when the value is out of range.
    [[nodiscard]] Result<void> setShape(int body, const physics::BodyShape& shape, const std::string& group = "");
    [[nodiscard]] Result<void> setMass(int body, float massKg, const std::string& group = "");
    [[nodiscard]] Result<void> setHinge(int constraint, const physics::HingeLimits& limits,
                                        const std::string& group = "");
    [[nodiscard]] Result<void> setCone(int constraint, const physics::ConeTwistLimits& limits,
                                       const std::string& group = "");
    [[nodiscard]] Result<void> setFriction(int constraint, float frictionNm, const std::string& group = "");
    /// Forgets the user's edits of one body and its constraint.
    [[nodiscard]] Result<void> resetPart(int body);
    /// Gives the body and constraint of the other side the values of this one.
    [[nodiscard]] Result<void> mirrorPart(int body);
    [[nodiscard]] Result<void> setFit(const physics::FitOptions& fit);
    /// Takes a profile from a file in place of the present one. Fails with ErrorCode::input when it can't be read or
    /// doesn't fit the skeleton.
    [[nodiscard]] Result<void> useProfile(const std::filesystem::path& file);

    /// What the ragdoll doctor says of the present profile; kept until that changes.
    [[nodiscard]] const physics::Diagnosis& diagnosis() const;
    /// Mends these findings (those that are mendable). Fails as physics::applyMends() does.
    [[nodiscard]] Result<void> mend(std::span<const physics::Finding> findings);

    /// The scene to begin with; not an edit.
    void startScene(const SceneSettings& scene) { state_.scene = scene; }
    /// Scenario, count, gravity, objects … Fails with ErrorCode::usage for what no scene can have.
    [[nodiscard]] Result<void> setScene(const SceneSettings& scene, const std::string& label,
                                        const std::string& group = "");

    /// Ends a group of changes (the mouse was released).
    void endGroup() { undo_.endGroup(); }
    /// Takes the open group of changes back without a trace in undo or redo; nothing when none is open.
    void cancelGroup();
    [[nodiscard]] bool canUndo() const { return undo_.canUndo(); }
    [[nodiscard]] bool canRedo() const { return undo_.canRedo(); }
    [[nodiscard]] std::string undoLabel() const { return undo_.undoLabel(); }
    [[nodiscard]] std::string redoLabel() const { return undo_.redoLabel(); }
    void undo();
    void redo();

    /// Whether the profile differs from what was loaded, fitted at opening, or saved last.
    [[nodiscard]] bool unsaved() const { return unsaved_; }
    /// Where save() writes: the profile that was loaded or saved last; beside the model else.
    [[nodiscard]] std::filesystem::path profileFile() const;
    [[nodiscard]] Result<void> save(const std::filesystem::path& file);

  private:
    using Change = std::function<Result<void>(DocumentState&)>;
    Result<void> apply(const std::string& label, const std::string& group, const Change& change);
    Result<void> editPart(int body, const std::string& what, const std::string& group,
                          const std::function<void(PartEdits&)>& change);
    [[nodiscard]] std::array<PartEdits, animation::kRoleCount> editsOfBase(const DocumentState& state) const;
    [[nodiscard]] Result<void> remap(DocumentState& state) const;
    void adopt(DocumentState state);

    std::unique_ptr<scene::RagdollAsset> asset_;
    DocumentState state_;
    UndoStack<DocumentState> undo_;
    std::uint64_t revision_ = 1;
    std::filesystem::path profileFile_;
    mutable physics::Diagnosis diagnosis_;
    mutable std::uint64_t diagnosedRevision_ = 0;
    std::string savedProfile_;  ///< As JSON.
    bool unsaved_ = false;
};

}  // namespace lutka::editor
