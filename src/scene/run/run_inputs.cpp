#include "scene/run/run_inputs.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/instruction_set.hpp"
#include "core/random.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::scene {
namespace {

std::uint32_t foldedHash(const physics::BodyState& body) {
    const std::uint64_t hash = hashBytes(&body, sizeof body);
    return static_cast<std::uint32_t>(hash ^ (hash >> 32U));
}

RunInputs::Check checkOf(const Simulation& simulation) {
    RunInputs::Check check{simulation.steps(), {}};
    std::vector<physics::BodyState> bodies;
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        bodies.resize(simulation.assetOf(doll).profile.bodies.size());
        simulation.getBodies(doll, bodies);
        std::transform(bodies.begin(), bodies.end(), std::back_inserter(check.bodies), foldedHash);
    }
    for (const physics::PropId prop : simulation.world().props())
        check.bodies.push_back(foldedHash(simulation.world().propState(prop)));
    return check;
}

std::string_view nameOf(InstructionSet set) {
    switch (set) {
        case InstructionSet::avx512:
            return "AVX-512";
        case InstructionSet::avx2:
            return "AVX2";
        case InstructionSet::baseline:
            break;
    }
    return "baseline";
}

// The doll and body of a place in a check; a doll of -1 is a prop.
InputDifference placed(const Simulation& simulation, std::size_t place) {
    InputDifference difference{simulation.steps(), -1, 0, 0};
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const std::size_t bodies = simulation.assetOf(doll).profile.bodies.size();
        if (place < bodies) {
            difference.doll = doll;
            break;
        }
        place -= bodies;
    }
    difference.body = static_cast<int>(place);
    return difference;
}

bool isThere(const Simulation& simulation, int doll, int body) {
    return doll >= 0 && doll < simulation.dollCount() && body >= 0 &&
           body < static_cast<int>(simulation.assetOf(doll).profile.bodies.size());
}

}  // namespace

std::uint64_t profilesHash(const Simulation& simulation) {
    std::uint64_t hash = kHashStart;
    for (const RagdollAsset* asset : simulation.assets()) {
        const std::string text = physics::profileToJson(asset->profile);
        hash = hashBytes(text.data(), text.size(), hash);
    }
    return hash;
}

RunInputs beginInputs(const Simulation& simulation, const std::string& program) {
    RunInputs inputs;
    inputs.program = program + ", " + std::string(nameOf(bestInstructionSet()));
    inputs.model = simulation.asset().character.name;
    inputs.profile = profilesHash(simulation);
    inputs.checks.push_back(checkOf(simulation));
    return inputs;
}

InputPlayer::InputPlayer(const RunInputs& inputs, Simulation& simulation)
    : inputs_(inputs), simulation_(simulation), drags_(inputs.pulls.size()) {}

void InputPlayer::beforeStep() {
    const int step = simulation_.steps();
    physics::World& world = simulation_.world();
    for (std::size_t i = 0; i < inputs_.pulls.size(); ++i) {
        const TimedPull& pull = inputs_.pulls[i];
        if (drags_[i].isSet() && step >= pull.until) world.removeDrag(std::exchange(drags_[i], {}));
        if (step != pull.from || pull.until <= pull.from || !isThere(simulation_, pull.doll, pull.body)) continue;
        drags_[i] =
            world.addDrag({simulation_.dollId(pull.doll), pull.body, pull.bodyPoint, pull.worldTarget, pull.maxForceN});
    }
    for (const TimedHit& hit : inputs_.hits) {
        if (hit.step != step || !isThere(simulation_, hit.doll, hit.body)) continue;
        const RigidTransform& worldFromBody = simulation_.worldFromBody(hit.doll)[hit.body];
        world.applyImpulse(simulation_.dollId(hit.doll), hit.body, hit.impulse, worldFromBody * hit.bodyPoint);
    }
}

void noteStep(const Simulation& simulation, bool last, RunInputs& inputs) {
    inputs.steps = simulation.steps();
    if (last || inputs.steps % RunInputs::kStepsACheck == 0) inputs.checks.push_back(checkOf(simulation));
}

std::optional<InputDifference> differenceFrom(const Simulation& simulation, const RunInputs& inputs) {
    const auto known = std::find_if(inputs.checks.begin(), inputs.checks.end(),
                                    [&](const RunInputs::Check& check) { return check.step == simulation.steps(); });
    if (known == inputs.checks.end()) return std::nullopt;
    const RunInputs::Check now = checkOf(simulation);
    if (now.bodies.size() != known->bodies.size())
        return InputDifference{now.step, 0, 0, static_cast<int>(std::max(now.bodies.size(), known->bodies.size()))};
    std::optional<InputDifference> first;
    for (std::size_t i = 0; i < now.bodies.size(); ++i) {
        if (now.bodies[i] == known->bodies[i]) continue;
        if (!first) first = placed(simulation, i);
        ++first->differing;
    }
    return first;
}

}  // namespace lutka::scene
