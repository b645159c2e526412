#include "editor/document/editor_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "editor/document/mend_profile.hpp"
#include "editor/document/mirror_body.hpp"
#include "editor/document/mirror_roles.hpp"
#include "editor/document/open_document.hpp"
#include "physics/profile/profile_io.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::editor {
namespace {

using animation::Role;
using animation::Side;
using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::RagdollProfile;

Error outOfRange(const std::vector<std::string>& problems) {
    return {ErrorCode::usage, fmt::format("{}", fmt::join(problems, "; ")), "", "choose a value inside the range"};
}

// Where what moves begins. Who is placed elsewhere begins anew, as who comes in does.
std::vector<std::tuple<scene::EntityId, vec3, quat>> startsOf(const scene::EntityScene& scene) {
    const std::vector<RigidTransform> places = scene::worldFromEntities(scene);
    std::vector<std::tuple<scene::EntityId, vec3, quat>> starts;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const scene::EntityId id = scene.entities[i].id;
        if (scene.find<scene::Ragdoll>(id) != nullptr || scene.find<scene::RigidBody>(id) != nullptr)
            starts.emplace_back(id, places[i].translation, places[i].rotation);
    }
    return starts;
}

}  // namespace

Result<std::unique_ptr<EditorDocument>> EditorDocument::open(const std::filesystem::path& model,
                                                             const scene::LoadOptions& options,
                                                             const physics::FitOptions& others) {
    auto asset = scene::loadRagdoll(model, options);
    if (!asset) return asset.error();
    auto document = std::make_unique<EditorDocument>(std::move(asset).value());
    document->state_.fit = options.fit;
    if (!physics::hasRoles(document->state_.profile)) document->state_.fit.rig = physics::RigKind::any;
    document->scene_.setOrigin(options.import, others, options.profile.value_or(""));
    if (options.profile) {
        document->state_.openedProfile = *options.profile;
        document->remember(*options.profile);
        document->rememberBase(document->state_);
    }
    return document;
}

EditorDocument::EditorDocument(std::unique_ptr<scene::RagdollAsset> asset) : asset_(std::move(asset)), scene_(*asset_) {
    state_.map = asset_->map;
    state_.base = asset_->profile;
    state_.profile = asset_->profile;
    beginHere();
    const Result<void> started = startScene({});
    LUTKA_ASSERT(started.ok());
}

void EditorDocument::beginHere() {
    saved_.begin(physics::profileToJson(state_.profile));
    unsaved_ = false;
    tellScene();
}

void EditorDocument::remember(const std::filesystem::path& file) {
    saved_.remember(state_.openedProfile, file, physics::profileToJson(state_.profile));
    unsaved_ = false;
    tellScene();
}

void EditorDocument::tellScene() {
    scene_.setProfileFile(profileFile(), saved_.fileOf(state_.openedProfile).has_value());
}

void EditorDocument::commitAsset() {
    asset_->map = state_.map;
    asset_->profile = state_.profile;
    auto rig = physics::bindRig(state_.profile, asset_->character.skeleton);
    LUTKA_ASSERT(rig.ok());  // apply() has bound it before
    if (rig) asset_->rig = std::move(rig).value();
}

void EditorDocument::adopt(Snapshot snapshot) {
    state_ = std::move(snapshot.ragdoll);
    ++revision_;
    unsaved_ = saved_.differs(state_.openedProfile, physics::profileToJson(state_.profile));
    tellScene();
    scene_.adopt(std::move(snapshot.scene));
}

// Works on a copy, so that a change that fails half-way leaves nothing behind.
Result<void> EditorDocument::apply(const std::string& label, const std::string& group, const Change& change) {
    DocumentState next = state_;
    if (auto done = change(next); !done) return done;
    next.profile = applyEdits(next.base, next.edits, next.pairs);
    if (const auto problems = physics::validate(next.profile); !problems.empty()) return outOfRange(problems);
    if (const auto rig = physics::bindRig(next.profile, asset_->character.skeleton); !rig) return rig.error();
    if (!undo_.join(group)) undo_.changed(snapshot(), label, group);
    adopt({std::move(next), scene_.settings(), nullptr});
    return {};
}

Result<void> EditorDocument::startScene(SceneSettings scene) {
    if (auto started = scene_.start(std::move(scene)); !started) return started;
    ++revision_;
    return {};
}

Result<void> EditorDocument::setScene(const SceneSettings& scene, const std::string& label, const std::string& group,
                                      bool moves) {
    auto next = scene_.prepare(scene);
    if (!next) return next.error();
    const bool begins = moves || startsOf(next.value().entities) != startsOf(scene_.settings().entities);
    if (!undo_.join(group, begins)) undo_.changed(snapshot(), label, group, begins);
    adopt({state_, std::move(next).value(), nullptr});
    return {};
}

Result<void> EditorDocument::recoverScene(const SceneSettings& scene) {
    auto next = scene_.prepareMade(scene);
    if (!next) return next.error();
    undo_.changed(snapshot(), "Recover the scene", "", true);
    adopt({state_, std::move(next).value(), nullptr});
    return {};
}

Result<void> EditorDocument::useScene(const std::filesystem::path& file, const scene::EntityScene& scene) {
    SceneSettings next = scene_.settings();
    next.entities = scene;
    next.scenario.clear();
    next.made.clear();
    if (auto done = setScene(next, "Open scene " + file.filename().string(), "", true); !done) return done;
    scene_.setFile(file);
    return {};
}

// What the base changes of a plain fit.
void EditorDocument::rememberBase(DocumentState& state) const {
    state.baseEdits = {};
    state.basePairs.clear();
    state.baseBodies = {};
    const auto plain = physics::fitRagdoll(asset_->character, state.map, state.fit);
    if (!plain) return;
    state.baseBodies = bodySetBetween(plain.value(), state.base);
    const RagdollProfile fitted = withBodySet(plain.value(), asset_->character, state.map, state.baseBodies);
    state.baseEdits = editsBetween(fitted, state.base);
    state.basePairs = pairEditsBetween(fitted, state.base);
}

void EditorDocument::takeAsBase(DocumentState& state, RagdollProfile profile) const {
    state.base = std::move(profile);
    state.edits = {};
    state.pairs.clear();
    rememberBase(state);
}

Result<void> EditorDocument::remap(DocumentState& state) const {
    fillUnset(state.edits, state.baseEdits);
    fillUnset(state.pairs, state.basePairs);
    state.baseEdits = {};
    state.basePairs.clear();
    if (state.fit.rig == physics::RigKind::any) {
        const auto isFixed = [](const std::optional<int>& joint) { return joint.has_value(); };
        if (std::any_of(state.fixed.begin(), state.fixed.end(), isFixed))
            return Error{ErrorCode::input, "a ragdoll of any skeleton has no roles to map", "", "open a humanoid"};
    } else {
        auto map = mapWithFixed(asset_->character, state.fixed);
        if (!map) return map.error();
        state.map = std::move(map).value();
    }
    auto profile = physics::fitRagdoll(asset_->character, state.map, state.fit);
    if (!profile) return profile.error();
    state.base = withBodySet(std::move(profile).value(), asset_->character, state.map, state.baseBodies);
    return {};
}

Result<void> EditorDocument::assignRole(Role role, int joint) {
    LUTKA_ASSERT(joint >= 0 && joint < character().skeleton.jointCount());
    const std::string label = fmt::format("Map {} to {}", animation::roleName(role), character().skeleton.names[joint]);
    return apply(label, "", [&](DocumentState& next) -> Result<void> {
        // The joint changes hands: whoever had it by the user's word is free again.
        for (auto& fixed : next.fixed) {
            if (fixed == joint) fixed.reset();
        }
        next.fixed[animation::indexOf(role)] = joint;
        return remap(next);
    });
}

Result<void> EditorDocument::unmapRole(Role role) {
    return apply(fmt::format("Unmap {}", animation::roleName(role)), "", [&](DocumentState& next) {
        next.fixed[animation::indexOf(role)] = animation::kNoJoint;
        return remap(next);
    });
}

Result<void> EditorDocument::mirrorRoles(Side from) {
    return apply(from == Side::left ? "Mirror mapping left to right" : "Mirror mapping right to left", "",
                 [&](DocumentState& next) -> Result<void> {
                     if (auto done = mirrorFixed(next, character(), from); !done) return done;
                     return remap(next);
                 });
}

Result<void> EditorDocument::mapAgain(bool forgetFixed) {
    return apply(forgetFixed ? "Map from scratch" : "Map again", "", [&](DocumentState& next) {
        if (forgetFixed) next.fixed = {};
        return remap(next);
    });
}

Result<void> EditorDocument::setFit(const physics::FitOptions& fit) {
    return apply("Fit", "", [&](DocumentState& next) {
        next.fit = fit;
        return remap(next);
    });
}

Result<void> EditorDocument::useProfile(const std::filesystem::path& file) {
    auto bound = profileFor(file, character(), state_.map);
    if (!bound) return bound.error();
    const bool isOwn = !bound.value().rebound;
    auto done = apply("Open profile " + file.filename().string(), "", [&](DocumentState& next) -> Result<void> {
        if (isOwn) next.openedProfile = file;
        takeAsBase(next, std::move(bound).value().profile);
        return {};
    });
    if (done && isOwn) remember(file);
    return done;
}

const physics::Diagnosis& EditorDocument::diagnosis() const {
    if (diagnosedRevision_ != revision_) {
        diagnosis_ = physics::diagnose(state_.profile, character(), state_.map);
        diagnosedRevision_ = revision_;
    }
    return diagnosis_;
}

bool EditorDocument::canMend(const physics::Finding& finding) const {
    return finding.mendable || !fixedToBlame(state_, diagnosis().findings, std::span(&finding, 1)).empty();
}

Result<void> EditorDocument::mend(std::span<const physics::Finding> findings) {
    const std::string label = findings.size() == 1 ? "Mend " + findings.front().code : "Mend all";
    return apply(label, "", [&](DocumentState& next) -> Result<void> {
        const std::vector<Role> wrong = fixedToBlame(next, diagnosis().findings, findings);
        for (const Role role : wrong)
            next.fixed[animation::indexOf(role)].reset();
        if (!wrong.empty()) {
            if (auto mapped = remap(next); !mapped) return mapped;
            next.profile = applyEdits(next.base, next.edits, next.pairs);
        }
        auto mended = mendProfile(next.profile, character(), next.map, findings, !wrong.empty());
        if (!mended) return mended.error();
        takeAsBase(next, std::move(mended).value());
        return {};
    });
}

void EditorDocument::cancelGroup() {
    if (undo_.groupIsOpen()) adopt(undo_.cancelGroup());
}

void EditorDocument::endGroup() {
    const auto isAsBefore = [this](const Snapshot& before) {
        const SceneSettings& was = before.scene;
        const SceneSettings& is = scene_.settings();
        return was.entities == is.entities && was.scenario == is.scenario && was.count == is.count &&
               was.seed == is.seed && was.pose == is.pose && was.clip == is.clip &&
               physics::profileToJson(before.ragdoll.profile) == physics::profileToJson(state_.profile);
    };
    // What began anew on the way is not where it was: its entry stays. All other ways to the same values go: an edit
    // that says no more than the fit would hold its part back from the next one.
    if (undo_.groupIsOpen() && !undo_.undoMoves() && isAsBefore(undo_.beforeGroup()))
        state_ = undo_.cancelGroup().ragdoll;
    undo_.endGroup();
}

EditorDocument::Snapshot EditorDocument::snapshot() const {
    return {state_, scene_.settings(), capturePlay_ ? capturePlay_() : nullptr};
}

EditorDocument::Step EditorDocument::undo() {
    if (!undo_.canUndo()) return {};
    const bool moves = undo_.undoMoves();
    Snapshot before = undo_.undo(snapshot());
    Step step{before.play, moves};
    adopt(std::move(before));
    return step;
}

EditorDocument::Step EditorDocument::redo() {
    if (!undo_.canRedo()) return {};
    const bool moves = undo_.redoMoves();
    Snapshot after = undo_.redo(snapshot());
    Step step{after.play, moves};
    adopt(std::move(after));
    return step;
}

void EditorDocument::moved(const std::string& label, std::shared_ptr<const PlayState> before, bool moves) {
    if (before != nullptr) undo_.changed({state_, scene_.settings(), std::move(before)}, label, "", moves);
}

Result<void> EditorDocument::recover(const std::array<std::optional<int>, animation::kRoleCount>& fixed,
                                     const RagdollProfile& profile) {
    return apply("Recover the ragdoll", "", [&](DocumentState& next) -> Result<void> {
        const bool any = std::any_of(fixed.begin(), fixed.end(), [](const auto& joint) { return joint.has_value(); });
        if (any) {
            auto map = mapWithFixed(character(), fixed);
            if (!map) return map.error();
            next.map = std::move(map).value();
            next.fixed = fixed;
        }
        takeAsBase(next, profile);
        return {};
    });
}

Result<void> EditorDocument::takeEditsOf(const EditorDocument& old) {
    symmetric_ = old.symmetric_;
    if (!old.state_.openedProfile.empty()) saved_ = old.saved_;
    return apply("Read the model again", "", [&](DocumentState& next) {
        DocumentState edited = old.state_;
        takeFixedTo(edited, old.character().skeleton, character().skeleton);
        edited.map = next.map;
        next = std::move(edited);
        return remap(next);
    });
}

std::filesystem::path EditorDocument::profileFile() const {
    if (const auto saved = saved_.fileOf(state_.openedProfile)) return *saved;
    const std::filesystem::path& model = character().file;
    std::filesystem::path file = model.parent_path() / (model.empty() ? character().name : model.stem().string());
    return file += ".ragdoll.json";
}

Result<void> EditorDocument::save(const std::filesystem::path& file) {
    if (auto saved = physics::saveProfile(file, state_.profile); !saved) return saved;
    remember(file);
    return {};
}

}  // namespace lutka::editor
