#include <fmt/format.h>

#include "bindings/profile_object.hpp"
#include "bindings/ragdoll_object.hpp"

namespace lutka::python {
namespace {

// The program beside the module that reads models in a process of its own; where it isn't there, they are read in this
// one.
std::filesystem::path importWorker() {
    const auto module = py::module_::import("lutka._lutka").attr("__file__").cast<std::filesystem::path>();
    const std::filesystem::path worker = module.parent_path() / "_import_worker";
    std::error_code failed;
    return std::filesystem::exists(worker, failed) ? worker : std::filesystem::path();
}

// Whether a signal handler raised, which stays raised for heedSignals() of whoever started the reading.
bool signalled() {
    const py::gil_scoped_acquire held;
    return PyErr_CheckSignals() != 0;
}

// "neck,toes" or ["neck", "toes"].
void takeBodies(Keywords& keywords, physics::FitOptions& fit) {
    py::object given;
    if (!keywords.take("bodies", given)) return;
    if (py::isinstance<py::str>(given)) given = given.attr("split")(",");
    for (const py::handle word : py::reinterpret_borrow<py::iterable>(given))
        orRaise(scene::addExtraBodies(py::str(word).attr("strip")().cast<std::string>(), fit));
}

void takePreset(Keywords& keywords, physics::FitOptions& fit) {
    std::string preset;
    if (!keywords.take("preset", preset)) return;
    const auto known = scene::presetNamed(preset);
    if (known) {
        fit.preset = *known;
        return;
    }
    std::vector<std::string> names;
    for (const physics::PresetInfo& info : physics::presetInfos())
        names.emplace_back(info.name);
    keywords.refuseWord("preset", preset, names);
}

}  // namespace

animation::ImportOptions importOptions(Keywords& keywords) {
    animation::ImportOptions options;
    keywords.take("scale", options.metresPerFileUnit, 1e-6, 1e6);
    animation::UpAxis up{};
    if (keywords.takeWord("up", scene::kUpAxisWords, up)) options.up = up;
    keywords.take("figure", options.figure, 1, 10000);
    options.loadTextures = false;
    keywords.take("textures", options.loadTextures);
    keywords.take("allow_outside", options.allowOutside);
    bool inProcess = false;
    keywords.take("in_process", inProcess);
    int memoryMiB = 1536;
    keywords.take("import_memory", memoryMiB, 64, 1 << 20);
    if (!inProcess) options.worker.program = importWorker();
    options.worker.memoryBytes = static_cast<std::size_t>(memoryMiB) << 20U;
    options.worker.stop = signalled;
    return options;
}

scene::LoadOptions loadOptions(Keywords& keywords) {
    scene::LoadOptions options;
    options.import = importOptions(keywords);
    py::object profile;
    if (keywords.take("profile", profile)) {
        if (py::isinstance<ProfileObject>(profile))
            options.given = profile.cast<const ProfileObject&>().get();
        else
            keywords.take("profile", options.profile);
    }
    keywords.take("keep_shapes", options.keepShapes);
    keywords.take("refit", options.refit);
    physics::FitOptions& fit = options.fit;
    keywords.takeWord("rig", scene::kRigWords, fit.rig);
    keywords.take("max_bodies", fit.mostBodies, 1, physics::RagdollProfile::kMostBodies);
    keywords.take("max_shapes", fit.mostShapes, 1, 1 + static_cast<int>(physics::BodyShape::kMostAdded));
    keywords.take("hulls", fit.hulls);
    fit.weighByVolume = !keywords.take("mass", fit.totalMassKg, 1e-3, 1e5);
    keywords.takeWord("mass_table", scene::kMassTableWords, fit.massTable);
    keywords.takeWord("masses", scene::kMassPresetWords, fit.massPreset);
    takePreset(keywords, fit);
    takeBodies(keywords, fit);
    return options;
}

}  // namespace lutka::python
