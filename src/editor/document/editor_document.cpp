#include "editor/document/editor_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "physics/profile/profile_io.hpp"
#include "physics/rig/rig.hpp"

namespace lutka::editor {
namespace {

using animation::Role;
using animation::Side;

Error outOfRange(const std::vector<std::string>& problems) {
    std::string all;
    for (const std::string& problem : problems)
        all += fmt::format("{}{}", all.empty() ? "" : "; ", problem);
    return {ErrorCode::usage, all, "", "choose a value inside the range"};
}

std::string partName(const physics::RagdollProfile& profile, int body) {
    return std::string(animation::roleName(profile.bodies[body].role));
}

// The joint nearest to the mirror image of `joint` in the standard stance; kNoJoint when none is within a tenth of the
// figure's height.
int mirroredJoint(const animation::Character& character, const DocumentState& state, int joint) {
    const auto& frames = character.skeleton.bindModelFromJoint;
    const quat& standard = state.map.standardFromModel;
    const float middle = (standard * frames[state.map.jointOf(Role::hips)].translation).x;
    vec3 wanted = standard * frames[joint].translation;
    wanted.x = 2.0F * middle - wanted.x;
    int best = animation::kNoJoint;
    float bestDistance = state.profile.heightM * 0.1F;
    for (int other = 0; other < character.skeleton.jointCount(); ++other) {
        const float distance = glm::distance(standard * frames[other].translation, wanted);
        // Helpers often share a place with the joint that deforms; the skin tells them apart.
        const bool deforms =
            character.skeleton.skinWeight[other] > 0.0F || character.skeleton.skinWeight[joint] <= 0.0F;
        if (other == joint || !deforms || distance >= bestDistance) continue;
        best = other;
        bestDistance = distance;
    }
    return best;
}

}  // namespace

Result<std::unique_ptr<EditorDocument>> EditorDocument::open(const std::filesystem::path& model,
                                                             const scene::LoadOptions& options) {
    auto asset = scene::loadRagdoll(model, options);
    if (!asset) return asset.error();
    auto document = std::make_unique<EditorDocument>(std::move(asset).value());
    document->state_.fit = options.fit;
    document->load_.import = options.import;
    if (options.profile) {
        document->state_.openedProfile = *options.profile;
        document->openedWith_ = *options.profile;
        document->remember(*options.profile);
        document->rememberBase(document->state_);
    }
    return document;
}

EditorDocument::EditorDocument(std::unique_ptr<scene::RagdollAsset> asset) : asset_(std::move(asset)) {
    state_.map = asset_->map;
    state_.base = asset_->profile;
    state_.profile = asset_->profile;
    saved_[{}] = {{}, physics::profileToJson(state_.profile)};
    const Result<void> started = startScene({});
    LUTKA_ASSERT(started.ok());
}

void EditorDocument::remember(const std::filesystem::path& file) {
    saved_[state_.openedProfile] = {file, physics::profileToJson(state_.profile)};
    ownFiles_.push_back(file);
    unsaved_ = false;
}

void EditorDocument::commitAsset() {
    asset_->map = state_.map;
    asset_->profile = state_.profile;
    auto rig = physics::bindRig(state_.profile, asset_->character.skeleton);
    LUTKA_ASSERT(rig.ok());  // apply() has bound it before
    if (rig) asset_->rig = std::move(rig).value();
}

void EditorDocument::adopt(DocumentState state) {
    state_ = std::move(state);
    ++revision_;
    unsaved_ = physics::profileToJson(state_.profile) != saved_[state_.openedProfile].profile;
    followScene();
}

// Works on a copy, so that a change that fails half-way leaves nothing behind.
Result<void> EditorDocument::apply(const std::string& label, const std::string& group, const Change& change) {
    DocumentState next = state_;
    if (auto done = change(next); !done) return done;
    next.profile = applyEdits(next.base, next.edits, next.pairs);
    if (const auto problems = physics::validate(next.profile); !problems.empty()) return outOfRange(problems);
    if (const auto rig = physics::bindRig(next.profile, asset_->character.skeleton); !rig) return rig.error();
    undo_.changed(state_, label, group);
    adopt(std::move(next));
    return {};
}

// What the base changes of a plain fit.
void EditorDocument::rememberBase(DocumentState& state) const {
    state.baseEdits = {};
    state.basePairs.clear();
    const auto fitted = physics::fitRagdoll(asset_->character, state.map, state.fit);
    if (!fitted) return;
    state.baseEdits = editsBetween(fitted.value(), state.base);
    state.basePairs = pairEditsBetween(fitted.value(), state.base);
}

Result<void> EditorDocument::remap(DocumentState& state) const {
    fillUnset(state.edits, state.baseEdits);
    fillUnset(state.pairs, state.basePairs);
    state.baseEdits = {};
    state.basePairs.clear();
    auto map = mapWithFixed(asset_->character, state.fixed);
    if (!map) return map.error();
    state.map = std::move(map).value();
    auto profile = physics::fitRagdoll(asset_->character, state.map, state.fit);
    if (!profile) return profile.error();
    state.base = std::move(profile).value();
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
                     for (int i = 0; i < animation::kRoleCount; ++i) {
                         const Role role = animation::roleAt(i);
                         const int joint = next.map.jointOf(role);
                         if (animation::sideOf(role) != from || joint == animation::kNoJoint) continue;
                         const int other = mirroredJoint(character(), next, joint);
                         if (other == animation::kNoJoint) {
                             return Error{
                                 ErrorCode::input,
                                 fmt::format("\"{}\" has no joint opposite to it", character().skeleton.names[joint]),
                                 "", "assign the role by hand"};
                         }
                         next.fixed[i] = joint;
                         next.fixed[animation::indexOf(animation::mirrored(role))] = other;
                     }
                     return remap(next);
                 });
}

Result<void> EditorDocument::mapAgain(bool forgetFixed) {
    return apply(forgetFixed ? "Map from scratch" : "Map again", "", [&](DocumentState& next) {
        if (forgetFixed) next.fixed = {};
        return remap(next);
    });
}

Result<void> EditorDocument::editPart(int body, const std::string& what, const std::string& group,
                                      const std::function<void(PartEdits&)>& change) {
    LUTKA_ASSERT(body >= 0 && body < static_cast<int>(profile().bodies.size()));
    const int role = animation::indexOf(profile().bodies[body].role);
    return apply(fmt::format("{} of {}", what, partName(profile(), body)), group,
                 [&](DocumentState& next) -> Result<void> {
                     change(next.edits[role]);
                     return {};
                 });
}

Result<void> EditorDocument::setShape(int body, const physics::BodyShape& shape, const std::string& group) {
    return editPart(body, "Shape", group, [&](PartEdits& edits) { edits.shape = shape; });
}

Result<void> EditorDocument::setMass(int body, float massKg, const std::string& group) {
    return editPart(body, "Mass", group, [&](PartEdits& edits) { edits.massKg = massKg; });
}

Result<void> EditorDocument::setHinge(int constraint, const physics::HingeLimits& limits, const std::string& group) {
    return editPart(profile().constraints[constraint].child, "Limits", group,
                    [&](PartEdits& edits) { edits.hinge = limits; });
}

Result<void> EditorDocument::setCone(int constraint, const physics::ConeTwistLimits& limits, const std::string& group) {
    return editPart(profile().constraints[constraint].child, "Limits", group,
                    [&](PartEdits& edits) { edits.cone = limits; });
}

Result<void> EditorDocument::setFriction(int constraint, float frictionNm, const std::string& group) {
    return editPart(profile().constraints[constraint].child, "Friction", group,
                    [&](PartEdits& edits) { edits.frictionNm = frictionNm; });
}

Result<void> EditorDocument::setFit(const physics::FitOptions& fit) {
    return apply("Fit", "", [&](DocumentState& next) {
        next.fit = fit;
        return remap(next);
    });
}

Result<void> EditorDocument::useProfile(const std::filesystem::path& file) {
    auto profile = physics::loadProfile(file);
    if (!profile) return profile.error();
    auto done = apply("Open profile " + file.filename().string(), "", [&](DocumentState& next) -> Result<void> {
        next.base = std::move(profile).value();
        next.edits = {};
        next.pairs.clear();
        next.openedProfile = file;
        rememberBase(next);
        return {};
    });
    if (!done) return done;
    remember(file);
    return done;
}

const physics::Diagnosis& EditorDocument::diagnosis() const {
    if (diagnosedRevision_ != revision_) {
        diagnosis_ = physics::diagnose(state_.profile, character(), state_.map);
        diagnosedRevision_ = revision_;
    }
    return diagnosis_;
}

Result<void> EditorDocument::mend(std::span<const physics::Finding> findings) {
    auto mended = physics::applyMends(state_.profile, character(), state_.map, findings);
    if (!mended) return mended.error();
    return apply(findings.size() == 1 ? "Mend " + findings.front().code : "Mend all", "",
                 [&](DocumentState& next) -> Result<void> {
                     next.base = std::move(mended).value();  // the edits are in it
                     next.edits = {};
                     next.pairs.clear();
                     rememberBase(next);
                     return {};
                 });
}

void EditorDocument::cancelGroup() {
    if (undo_.groupIsOpen()) adopt(undo_.cancelGroup());
}

void EditorDocument::undo() {
    if (undo_.canUndo()) adopt(undo_.undo(state_));
}

void EditorDocument::redo() {
    if (undo_.canRedo()) adopt(undo_.redo(state_));
}

std::filesystem::path EditorDocument::profileFile() const {
    const auto saved = saved_.find(state_.openedProfile);
    if (saved != saved_.end() && !saved->second.file.empty()) return saved->second.file;
    const std::filesystem::path& model = character().file;
    std::filesystem::path file = model.parent_path() / (model.empty() ? character().name : model.stem().string());
    return file += ".ragdoll.json";
}

bool EditorDocument::wouldReplace(const std::filesystem::path& file) const {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return false;
    return std::none_of(ownFiles_.begin(), ownFiles_.end(), [&](const std::filesystem::path& own) {
        return std::filesystem::equivalent(own, file, failed);
    });
}

Result<void> EditorDocument::save(const std::filesystem::path& file) {
    if (auto saved = physics::saveProfile(file, state_.profile); !saved) return saved;
    remember(file);
    return {};
}

}  // namespace lutka::editor
