#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "physics/doctor/doctor.hpp"
#include "physics/profile/profile_io.hpp"
#include "scene/measure/checkup.hpp"

namespace lutka::cli {
namespace {

struct CheckCommandOptions {
    RagdollOptions ragdoll;
    std::filesystem::path fixTo;
    bool json = false;
};

// Mends what can be mended, writes the profile, and looks again.
void mend(const CheckCommandOptions& options, scene::RagdollAsset& asset, scene::Checkup& checkup) {
    auto mended = orLeave(physics::applyMends(asset.profile, asset.character, asset.map, checkup.diagnosis.findings));
    orLeave(physics::saveProfile(options.fixTo, mended));
    asset.rig = orLeave(physics::bindRig(mended, asset.character.skeleton));
    asset.profile = std::move(mended);
    checkup = scene::examine(asset);
}

void runCheck(const CheckCommandOptions& options) {
    keepInputs(options.fixTo, {options.ragdoll.model.model});
    const auto asset = loadAsset(options.ragdoll);
    scene::Checkup checkup = [&] {
        const Stopwatch stopwatch("examining");
        return scene::examine(*asset);
    }();
    if (!options.fixTo.empty()) mend(options, *asset, checkup);
    const bool printed = isStandardOutput(options.fixTo);
    if (options.json && !printed) fmt::print("{}", scene::checkupJson(*asset, checkup));
    if (!options.json && !printed) tell("{}", scene::checkupText(*asset, checkup));
    if (checkup.diagnosis.hasErrors()) throw Exit{static_cast<int>(ErrorCode::findings)};
}

}  // namespace

void addCheck(const Command& app) {
    auto options = std::make_shared<CheckCommandOptions>();
    const Command command =
        app.add("check", "Examine a ragdoll: findings with measures and mends, three drops, one score");
    options->ragdoll.addTo(command);
    command.option("--fix", options->fixTo,
                   "write the profile with what can be mended to this file, and judge that; - for stdout");
    command.flag("--json", options->json, "print the findings as JSON on stdout");
    command.onRun([options] { runCheck(*options); });
}

}  // namespace lutka::cli
