#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <map>
#include <memory>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "physics/fit/limits_from_clips.hpp"
#include "physics/profile/joint_range.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::cli {
namespace {

struct BuildCommandOptions {
    RagdollOptions ragdoll;
    std::filesystem::path out;
    std::string limitsFromClips;  // empty: limits are the anatomy's
    bool json = false;
};

const std::map<std::string, physics::ClipLimits> kClipLimits = {{"widen", physics::ClipLimits::widen},
                                                                {"fit", physics::ClipLimits::fit}};

std::string hingeText(const physics::HingeLimits& hinge) {
    return fmt::format("{:.0f}..{:.0f}", degrees(hinge.lower), degrees(hinge.upper));
}

std::string coneText(const physics::ConeTwistLimits& cone) {
    return fmt::format("{:.0f} x {:.0f}, twist {:.0f}", degrees(cone.swingY), degrees(cone.swingZ),
                       degrees(cone.twist));
}

// Before, what the clips do, and after: in degrees from the middle of the range, as the profile has them.
void printChanges(const std::vector<physics::ClipLimitChange>& changes) {
    tell("{:<15} {:<22} {:<22} {:<22}\n", "DEG FROM MIDDLE", "ANATOMY", "CLIPS", "TAKEN");
    for (const physics::ClipLimitChange& change : changes) {
        const bool hinge = change.kind == physics::ConstraintProfile::Kind::hinge;
        tell("{:<15} {:<22} {:<22} {:<22}\n", change.body,
             hinge ? hingeText(change.hingeBefore) : coneText(change.coneBefore),
             hinge ? hingeText(change.hingeUsed) : coneText(change.coneUsed),
             hinge ? hingeText(change.hingeAfter) : coneText(change.coneAfter));
    }
}

std::string shapeText(const physics::PrimitiveShape& shape) {
    switch (shape.kind) {
        case physics::PrimitiveShape::Kind::capsule:
            return fmt::format("capsule r {:.3f} l {:.3f}", shape.radius, shape.halfLength * 2.0F);
        case physics::PrimitiveShape::Kind::sphere:
            return fmt::format("sphere r {:.3f}", shape.radius);
        case physics::PrimitiveShape::Kind::hull:
            return fmt::format("hull of {} corners", shape.hull->points().size());
        case physics::PrimitiveShape::Kind::box:
            break;
    }
    return fmt::format("box {:.3f} {:.3f} {:.3f}", shape.halfExtents.x * 2, shape.halfExtents.y * 2,
                       shape.halfExtents.z * 2);
}

std::string spanText(const physics::AngleSpan& span) {
    return fmt::format("{:.0f}..{:.0f}", degrees(span.low), degrees(span.high));
}

// From the bind pose, as the editor tells it: the file has both sides of the middle of the range, which says nothing
// to one who knows how far a knee bends.
std::string limitText(const physics::ConstraintProfile& c, const physics::Rig& rig) {
    const physics::JointRange range =
        physics::jointRange(c, {rig.bindModelFromBody[c.parent], rig.bindModelFromBody[c.child]});
    if (c.kind == physics::ConstraintProfile::Kind::hinge) return fmt::format("hinge {} deg", spanText(range.flexion));
    return fmt::format("cone {} by {}, twist {} deg", spanText(range.flexion), spanText(range.side),
                       spanText(range.twist));
}

void printTable(const physics::RagdollProfile& profile, const physics::Rig& rig) {
    tell("{:<15} {:<28} {:<26} {:>8}  {}\n", "BODY", "JOINT", "SHAPE (m)", "MASS", "LIMITS FROM THE BIND POSE");
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        const physics::BodyProfile& body = profile.bodies[i];
        tell("{:<15} {:<28} {:<26} {:>5.2f} kg  {}\n", body.name, body.joint, shapeText(body.shape), body.massKg,
             i == 0 ? "" : limitText(profile.constraints[i - 1], rig));
        for (const physics::AddedShape& added : body.shape.more)
            tell("{:<15} {:<28} {:<26}\n", "", "and", shapeText(added));
    }
    tell("{:.2f} m tall, {:.1f} kg, {} bodies, {} constraints, {} pairs that don't collide beside the linked\n",
         profile.heightM, profile.totalMassKg, profile.bodies.size(), profile.constraints.size(),
         profile.filteredPairs.size());
}

void runBuild(const BuildCommandOptions& options) {
    keepInputs(options.out, {options.ragdoll.model.model});
    const auto asset = loadAsset(options.ragdoll);
    printWarnings(*asset);
    std::vector<physics::ClipLimitChange> changes;
    if (!options.limitsFromClips.empty()) {
        changes = physics::applyClipLimits(asset->profile, asset->rig, asset->character,
                                           kClipLimits.at(options.limitsFromClips));
        if (changes.empty())
            spdlog::warn("{}: has no clips; the limits are the anatomy's", asset->character.file.string());
    }
    if (!options.out.empty()) orLeave(physics::saveProfile(options.out, asset->profile));
    if (isStandardOutput(options.out)) return;
    if (options.json) {
        fmt::print("{}", physics::profileToJson(asset->profile));
    } else {
        printTable(asset->profile, asset->rig);
        if (!changes.empty()) printChanges(changes);
    }
}

}  // namespace

void addBuild(const Command& app) {
    auto options = std::make_shared<BuildCommandOptions>();
    const Command command = app.add("build", "Make the whole ragdoll profile: map, fit, masses, limits, filter");
    options->ragdoll.addTo(command);
    command.option("-o,--output", options->out, "write the profile (*.ragdoll.json); - for stdout");
    command
        .option("--limits-from-clips", options->limitsFromClips,
                "widen: make room for what the model's own animations do; fit: allow just that")
        .oneOf(wordsOf(kClipLimits));
    command.flag("--json", options->json, "print the profile as JSON on stdout");
    command.onRun([options] { runBuild(*options); });
}

}  // namespace lutka::cli
