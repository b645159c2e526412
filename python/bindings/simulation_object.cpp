#include "bindings/simulation_object.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scene/description/scene_file.hpp"
#include "scene/run/scene_cast.hpp"

namespace lutka::python {

void SimulationObject::command(const char* call, const std::function<void(scene::Simulation&)>& work) {
    std::string refusal;
    use([&](scene::Simulation& simulation) {
        simulation.world().setRefusalSink([&refusal](std::string_view message) { refusal = message; });
        work(simulation);
        simulation.world().setRefusalSink({});
    });
    if (!refusal.empty())
        raise({ErrorCode::usage, refusal, std::string(call) + "()",
               "nothing was changed; give finite numbers of that range"});
}

RagdollPointer SimulationObject::ragdollOf(int doll) const {
    const auto index = static_cast<std::size_t>(facts().scenario().dolls[static_cast<std::size_t>(doll)].asset);
    return assets_[index];
}

std::span<const RigidTransform> SimulationObject::bodies() {
    if (facts().dollCount() == 0) return {};
    return {simulation_->worldFromBody(0).data(), facts().bodyCount()};
}

std::span<const RigidTransform> SimulationObject::bodies(int doll) {
    return simulation_->worldFromBody(doll);
}

int SimulationObject::checkedDoll(const char* call, int doll) const {
    if (doll >= 0 && doll < facts().dollCount()) return doll;
    raise({ErrorCode::usage, fmt::format("there is no doll {}", doll), std::string(call) + "()",
           fmt::format("the scene has {}, counted from 0", facts().dollCount())});
}

int SimulationObject::checkedBody(const char* call, int doll, const py::object& body) const {
    const physics::RagdollProfile& profile = ragdollOf(checkedDoll(call, doll))->profile;
    const int count = static_cast<int>(profile.bodies.size());
    if (py::isinstance<py::str>(body)) {
        const int named = physics::bodyNamed(profile, body.cast<std::string>());
        if (named >= 0) return named;
    } else if (PyIndex_Check(body.ptr()) != 0) {
        const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(body.ptr())).cast<long long>();
        if (index >= 0 && index < count) return static_cast<int>(index);
    } else {
        throw py::type_error(fmt::format("{}(): a body is told by its name or number", call));
    }
    std::vector<std::string> names;
    for (const physics::BodyProfile& other : profile.bodies)
        names.push_back(other.name);
    raise({ErrorCode::usage, fmt::format("there is no body {}", std::string(py::repr(body))), std::string(call) + "()",
           fmt::format("the doll has {}: {}", count, fmt::join(names, ", "))});
}

void SimulationObject::reset() {
    use([this](scene::Simulation& simulation) {
        simulation.reset();
        ++resets_;
    });
}

namespace {

// ("walk", 0.5) or "walk".
bool takeClip(Keywords& keywords, const char* name, scene::ClipStart& start) {
    py::object given;
    if (!keywords.take(name, given)) return false;
    if (py::isinstance<py::str>(given)) return keywords.take(name, start.clip);
    std::pair<std::string, float> moment;
    keywords.take(name, moment);
    start = {moment.first, moment.second};
    if (!std::isfinite(start.seconds))
        raise({ErrorCode::usage, "the moment is not finite", name, "give (clip, seconds)"});
    return true;
}

void takeWorld(Keywords& keywords, physics::WorldSettings& world) {
    std::string solver;
    if (keywords.take("solver", solver)) {
        const auto known = physics::solverNamed(solver);
        std::vector<std::string> names;
        for (const physics::SolverEntry& entry : physics::kSolvers)
            names.emplace_back(entry.name);
        if (!known) keywords.refuseWord("solver", solver, names);
        world.solver = *known;
    }
    keywords.take("threads", world.threads, 1, 256);
    keywords.take("sleeping", world.sleeping);
    if (keywords.take("gravity", world.gravity) && !isFinite(world.gravity))
        raise({ErrorCode::usage, "gravity is not finite", "Simulation()", "give three numbers, m/s²"});
    keywords.take("substeps", world.substeps, 1, 64);
    keywords.take("iterations", world.iterations, 1, 1000);
}

// Muscles follow a clip, or the start pose.
void takeMuscles(Keywords& keywords, const std::string& preset, const scene::ClipPlay& play,
                 scene::SimulationOptions& options) {
    const auto& names = physics::kMusclePresetNames;
    const auto known = std::find(names.begin(), names.end(), preset);
    scene::PuppetPlay puppet;
    puppet.ownMuscles = preset == "profile";
    if (known == names.end() && !puppet.ownMuscles)
        keywords.refuseWord("muscles", preset, {"limp", "weak", "powered", "stiff", "profile"});
    puppet.start = play.start;
    if (!puppet.ownMuscles)
        puppet.puppet.muscles = physics::musclesOf(static_cast<physics::MusclePreset>(known - names.begin()));
    keywords.take("strength", puppet.puppet.muscles.strength, 0.0, 1e6);
    float pin = 0.0F;
    if (keywords.take("pin", pin, 0.0, 1e6)) puppet.pinForceN = pin;
    options.puppet = puppet;
}

void takeOptions(Keywords& keywords, scene::SimulationOptions& options) {
    takeWorld(keywords, options.world);
    keywords.take("dt", options.dt, 1e-4, 0.1);
    keywords.take("measure", options.measure);
    std::string pose;
    if (keywords.take("pose", pose)) {
        if (pose != "bind" && pose != "node") keywords.refuseWord("pose", pose, {"bind", "node"});
        options.pose = pose == "node" ? scene::StartPose::node : scene::StartPose::bind;
    }
    scene::ClipStart from;
    if (takeClip(keywords, "from_clip", from)) options.fromClip = from;
    scene::ClipPlay play;
    const bool plays = takeClip(keywords, "clip", play.start);
    keywords.take("clip_speed", play.speed, -100.0, 100.0);
    keywords.take("loop", play.loop);
    keywords.take("in_place", play.inPlace);
    std::string muscles;
    if (keywords.take("muscles", muscles))
        takeMuscles(keywords, muscles, play, options);
    else if (plays)
        options.play = play;
    // Known even where no muscles were asked for, so that the refusal is about them.
    float unused = 0.0F;
    if (!options.puppet && (keywords.take("strength", unused) || keywords.take("pin", unused)))
        raise({ErrorCode::usage, "strength and pin belong to muscles", "Simulation()", "add muscles='powered'"});
}

SimulationPointer create(std::vector<RagdollPointer> assets, scene::Scenario scenario,
                         const scene::SimulationOptions& options) {
    std::vector<const scene::RagdollAsset*> pointers;
    pointers.reserve(assets.size());
    for (const RagdollPointer& asset : assets)
        pointers.push_back(asset.get());
    auto made = withoutGil([&] { return scene::Simulation::create(pointers, std::move(scenario), options); });
    return std::make_shared<SimulationObject>(std::move(assets), orRaise(std::move(made)));
}

}  // namespace

SimulationPointer makeSimulation(const RagdollObject& ragdoll, const std::string& scene, const py::kwargs& given) {
    Keywords keywords("Simulation", given);
    scene::NamedScene named{scene};
    keywords.take("count", named.count, 1, 10000);
    keywords.take("seed", named.seed);
    scene::SimulationOptions options;
    takeOptions(keywords, options);
    keywords.finish();
    auto scenario = withoutGil([&] { return scene::makeScenario(named, *ragdoll.asset); });
    return create({ragdoll.asset}, orRaise(std::move(scenario)), options);
}

SimulationPointer loadSimulation(const std::filesystem::path& file, const std::filesystem::path& model,
                                 const py::kwargs& given) {
    Keywords keywords("Simulation.load", given);
    const scene::EntityScene entities = orRaise(scene::loadScene(file));
    const scene::LoadOptions load = loadOptions(keywords);
    scene::SimulationOptions options = scene::simulationOptionsOf(entities);
    takeOptions(keywords, options);
    keywords.finish();
    auto loaded = withoutGil([&] { return scene::loadCast(entities, model, load); });
    heedSignals();
    scene::SceneCast cast = orRaise(std::move(loaded));
    scene::Scenario scenario = orRaise(scene::compileScene(entities, cast.figures(), cast.assetOfRagdoll));
    std::vector<RagdollPointer> assets;
    for (auto& asset : cast.assets)
        assets.emplace_back(std::move(asset));
    return create(std::move(assets), std::move(scenario), options);
}

}  // namespace lutka::python
