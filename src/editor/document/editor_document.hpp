#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/result.hpp"
#include "editor/document/document_state.hpp"
#include "editor/document/saved_profiles.hpp"
#include "editor/document/scene_document.hpp"
#include "editor/document/undo_stack.hpp"
#include "physics/doctor/doctor.hpp"
#include "physics/profile/joint_range.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::editor {

/// What a running scene is at a moment (editor/play/motion.hpp). The document only keeps it with its undo.
struct PlayState;

/// A character with the ragdoll that is being edited, and undo for it and for the scene it falls in. All editing goes
/// through here: every call below makes one entry of undo (or joins its group), is checked before it takes effect, and
/// leaves everything as it was when it fails. Knows no window, no UI and no running simulation.
class EditorDocument {
  public:
    /// Loads the model (and the profile of `options`, when it names one). `others`: SceneDocument::setOrigin().
    [[nodiscard]] static Result<std::unique_ptr<EditorDocument>> open(const std::filesystem::path& model,
                                                                      const scene::LoadOptions& options = {},
                                                                      const physics::FitOptions& others = {});
    /// For an asset that is there already.
    explicit EditorDocument(std::unique_ptr<scene::RagdollAsset> asset);
    EditorDocument(const EditorDocument&) = delete;  // its scene borrows its asset
    EditorDocument& operator=(const EditorDocument&) = delete;

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

    /// A body with the constraint it hangs by, as changeParts() offers them.
    struct Part {
        physics::BodyProfile& body;
        physics::ConstraintProfile* constraint;  ///< Nothing for the root.
        physics::BindFrames bind;                ///< Of the constraint's two bodies; for physics::setJointRange() & co.
    };
    /// The same change to several bodies, as one entry of undo: shapes and their places, masses, kinds, limits, axes,
    /// friction, strengths. A value that comes out as the fit has it is no edit. `what` names the change; `group` as in
    /// UndoStack. Fails with what `change` fails with, and with ErrorCode::usage as below.
    [[nodiscard]] Result<void> changeParts(std::span<const int> bodies, const std::string& what,
                                           const std::string& group, const std::function<Result<void>(Part&)>& change);

    /// What copying takes of a part; limits as they are told from the bind pose, so that they mean the same elsewhere.
    struct PartValues {
        animation::Side side = animation::Side::center;
        physics::BodyShape shape;
        float massKg = 1.0F;
        physics::MuscleFactors muscle;
        struct Joint {
            physics::ConstraintProfile::Kind kind = physics::ConstraintProfile::Kind::coneTwist;
            physics::JointRange range;
            float frictionNm = 0.0F;
            physics::JointSpring spring;  ///< Its rest as a turn from the bind pose.
        };
        std::optional<Joint> joint;  ///< Unless it was the root.
    };
    [[nodiscard]] PartValues copyPart(int body) const;
    /// Gives the values to all these bodies; side and twist are turned round for the other side of the body.
    [[nodiscard]] Result<void> pasteParts(std::span<const int> bodies, const PartValues& values);
    /// Gives the bodies on the other side the shapes, places, masses, kinds, limits and axes of these. Fails with
    /// ErrorCode::usage when one of them has no other side.
    [[nodiscard]] Result<void> mirrorParts(std::span<const int> bodies);
    /// Whether every change of a body goes to the body on the other side as well, as mirrorParts() would do it.
    [[nodiscard]] bool symmetric() const { return symmetric_; }
    void setSymmetric(bool symmetric) { symmetric_ = symmetric; }
    /// Other bodies than before (physics/fit/edit_bodies.hpp): what `change` makes of the profile takes its place, and
    /// the same bodies come and go with every new fit. Fails with what `change` fails with.
    [[nodiscard]] Result<void> changeBodies(
        const std::string& label,
        const std::function<Result<physics::RagdollProfile>(const physics::RagdollProfile&)>& change);
    /// What the ragdoll is now is what a session begins with: nothing of it is unsaved.
    void beginHere();
    /// Forgets the user's edits of these bodies and their constraints.
    [[nodiscard]] Result<void> resetParts(std::span<const int> bodies);
    /// Whether two bodies collide (in the ragdoll that has them both). Linked bodies never do: ErrorCode::usage.
    [[nodiscard]] Result<void> setCollision(int bodyA, int bodyB, bool collide);
    [[nodiscard]] bool collides(int bodyA, int bodyB) const;
    [[nodiscard]] bool linked(int bodyA, int bodyB) const;
    /// The bodies of a constraint in the bind pose of the present profile, in model space.
    [[nodiscard]] physics::BindFrames bindOf(int constraint) const;

    // Single bodies and constraints; indices into profile(). `group`: see UndoStack. Fail with ErrorCode::usage, naming
    // all that validate() finds, when the value is out of range.
    [[nodiscard]] Result<void> setShape(int body, const physics::BodyShape& shape, const std::string& group = "");
    [[nodiscard]] Result<void> setMass(int body, float massKg, const std::string& group = "");
    [[nodiscard]] Result<void> setHinge(int constraint, const physics::HingeLimits& limits,
                                        const std::string& group = "");
    [[nodiscard]] Result<void> setCone(int constraint, const physics::ConeTwistLimits& limits,
                                       const std::string& group = "");
    [[nodiscard]] Result<void> setFriction(int constraint, float frictionNm, const std::string& group = "");
    [[nodiscard]] Result<void> setFit(const physics::FitOptions& fit);
    /// Takes a profile from a file in place of the present one; another rig's is bound by role, and saved beside this
    /// model, not over its file. Fails with ErrorCode::input when it can't be read or doesn't fit the skeleton.
    [[nodiscard]] Result<void> useProfile(const std::filesystem::path& file);

    /// What the ragdoll doctor says of the present profile; kept until that changes.
    [[nodiscard]] const physics::Diagnosis& diagnosis() const;
    /// Whether mend() can do something about it.
    [[nodiscard]] bool canMend(const physics::Finding& finding) const;
    /// Mends these findings, as far as they are mendable, and others of the same kinds that come to light by it, as one
    /// entry of undo. Where a role on a wrong joint is the cause, that role is set free. Fails as
    /// physics::applyMends() does, and with ErrorCode::input when they come back every time.
    [[nodiscard]] Result<void> mend(std::span<const physics::Finding> findings);

    /// The scene's settings, characters and file. Its edits are these below, because undo has them.
    [[nodiscard]] SceneDocument& sceneDocument() { return scene_; }
    [[nodiscard]] const SceneDocument& sceneDocument() const { return scene_; }
    [[nodiscard]] const scene::EntityScene& scene() const { return scene_.scene(); }
    /// SceneDocument::start(); not an edit.
    [[nodiscard]] Result<void> startScene(SceneSettings scene);
    /// Entities, gravity, start pose … Fails as SceneDocument::prepare() does.
    /// `moves`: what runs begins anew with it, as it does whenever what moves comes, goes or is placed elsewhere: undo
    /// brings that back too.
    [[nodiscard]] Result<void> setScene(const SceneSettings& scene, const std::string& label,
                                        const std::string& group = "", bool moves = false);
    /// A scene from a file, in place of the present one and as one entry of undo, when its first character is the one
    /// that is edited or none has a model.
    [[nodiscard]] Result<void> useScene(const std::filesystem::path& file, const scene::EntityScene& scene);

    /// Ends a group of changes (the mouse was released, what was typed is done). One that ended as it began leaves
    /// no trace in the document, in undo or in redo, unless what runs has begun anew on the way.
    void endGroup();
    /// Takes the open group of changes back without a trace in undo or redo; nothing when none is open.
    void cancelGroup();
    [[nodiscard]] bool canUndo() const { return undo_.canUndo(); }
    [[nodiscard]] bool canRedo() const { return undo_.canRedo(); }
    [[nodiscard]] std::string undoLabel() const { return undo_.undoLabel(); }
    [[nodiscard]] std::string redoLabel() const { return undo_.redoLabel(); }
    [[nodiscard]] std::vector<std::string> undoLabels() const { return undo_.undoLabels(); }
    [[nodiscard]] std::vector<std::string> redoLabels() const { return undo_.redoLabels(); }
    /// What undo() or redo() brought back beside the documents.
    struct Step {
        std::shared_ptr<const PlayState> play;  ///< What ran then; null: nobody kept it.
        bool moves = false;                     ///< Whether the change was (also) one of what runs.
    };
    Step undo();
    Step redo();

    /// Who runs the scene: asked for its state before every change.
    void follow(std::function<std::shared_ptr<const PlayState>()> capture) { capturePlay_ = std::move(capture); }
    /// An entry of undo for a change of what runs alone: a pose, a ball, a pin. `before` is the state that undo goes
    /// back to; nothing is kept when it is null. `moves` is false for what leaves everything where it is.
    void moved(const std::string& label, std::shared_ptr<const PlayState> before, bool moves = true);

    /// Whether what is edited has a file: the profile that was opened, or saved last on what was opened; empty: none.
    [[nodiscard]] std::filesystem::path openedFile() const {
        return saved_.fileOf(state_.openedProfile).value_or(std::filesystem::path());
    }
    /// The scene of a recovered session, whose named scene was made already. Fails as setScene() does.
    [[nodiscard]] Result<void> recoverScene(const SceneSettings& scene);
    /// What a recovered session had: the roles that the user fixed and the profile, as one entry of undo. Fails with
    /// ErrorCode::input when they don't fit the skeleton.
    [[nodiscard]] Result<void> recover(const std::array<std::optional<int>, animation::kRoleCount>& fixed,
                                       const physics::RagdollProfile& profile);

    /// The edits of a document whose model was read again, as this one; joints are found by their paths. One entry of
    /// undo. Fails with ErrorCode::input when what the user fixed makes no humanoid any more.
    [[nodiscard]] Result<void> takeEditsOf(const EditorDocument& old);

    /// Whether the profile differs from what was loaded, fitted at opening, or saved last.
    [[nodiscard]] bool unsaved() const { return unsaved_; }
    /// Where save() writes: the profile that was loaded or saved last; beside the model else. Undoing the opening of a
    /// profile takes its file back with it.
    [[nodiscard]] std::filesystem::path profileFile() const;
    /// Whether saving there would replace a file that this document neither opened nor wrote.
    [[nodiscard]] bool wouldReplace(const std::filesystem::path& file) const { return saved_.wouldReplace(file); }
    [[nodiscard]] Result<void> save(const std::filesystem::path& file);

  private:
    using Change = std::function<Result<void>(DocumentState&)>;
    Result<void> apply(const std::string& label, const std::string& group, const Change& change);
    Result<void> editPart(int body, const std::string& what, const std::string& group,
                          const std::function<void(PartEdits&)>& change);
    [[nodiscard]] std::string partNames(std::span<const int> bodies) const;
    [[nodiscard]] std::vector<RigidTransform> bindModelFromBody(const physics::RagdollProfile& profile) const;
    void rememberBase(DocumentState& state) const;
    /// A profile with all edits in it takes the place of the fit.
    void takeAsBase(DocumentState& state, physics::RagdollProfile profile) const;
    /// Gives the bodies on the other side what these have in `state`, which asks for no more than valid joints.
    void mirrorOnto(DocumentState& state, std::span<const int> bodies) const;
    [[nodiscard]] Result<void> remap(DocumentState& state) const;
    struct Snapshot {
        DocumentState ragdoll;
        SceneSettings scene;
        std::shared_ptr<const PlayState> play;
    };
    [[nodiscard]] Snapshot snapshot() const;
    void adopt(Snapshot snapshot);
    void tellScene();
    void remember(const std::filesystem::path& file);

    std::unique_ptr<scene::RagdollAsset> asset_;
    SceneDocument scene_;
    DocumentState state_;
    UndoStack<Snapshot> undo_;
    std::function<std::shared_ptr<const PlayState>()> capturePlay_;
    std::uint64_t revision_ = 1;
    mutable physics::Diagnosis diagnosis_;
    mutable std::uint64_t diagnosedRevision_ = 0;
    SavedProfiles saved_;
    bool unsaved_ = false;
    bool symmetric_ = false;
};

}  // namespace lutka::editor
