#include <fmt/format.h>

#include <map>

#include "animation/humanoid/map_humanoid.hpp"
#include "bindings/keep_model.hpp"
#include "bindings/profile_object.hpp"
#include "bindings/ragdoll_object.hpp"
#include "bindings/sealed.hpp"
#include "core/files.hpp"
#include "export/export_ragdoll.hpp"
#include "scene/measure/checkup.hpp"

namespace lutka::python {
namespace {

// Names in files are bytes of any encoding: what isn't UTF-8 is replaced.
std::string readable(const std::string& bytes) {
    return py::bytes(bytes).attr("decode")("utf-8", "replace").cast<std::string>();
}
std::vector<std::string> readable(const std::vector<std::string>& all) {
    std::vector<std::string> list;
    list.reserve(all.size());
    for (const std::string& one : all)
        list.push_back(readable(one));
    return list;
}

struct BindingObject {
    std::string joint;
    std::string path;
    float confidence = 0.0F;
    std::string reason;
};

struct MapObject {
    bool humanoid = false;
    float confidence = 0.0F;
    std::map<std::string, BindingObject> roles;
    std::vector<std::string> missing;
    std::vector<std::string> warnings;
};

MapObject mapObject(const animation::Skeleton& skeleton, const animation::HumanoidMap& map) {
    MapObject object{map.humanoid, map.confidence, {}, {}, readable(map.warnings)};
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const auto& binding = map.roles[static_cast<std::size_t>(index)];
        if (!binding) continue;
        object.roles[std::string(animation::roleName(animation::roleAt(index)))] = {
            readable(skeleton.names[static_cast<std::size_t>(binding->joint)]),
            readable(animation::jointPath(skeleton, binding->joint)), binding->confidence, readable(binding->reason)};
    }
    for (const animation::Role role : map.missing)
        object.missing.emplace_back(animation::roleName(role));
    return object;
}

MapObject map(const std::filesystem::path& model, const py::kwargs& given) {
    Keywords keywords("map", given);
    const animation::ImportOptions import = importOptions(keywords);
    animation::MapOptions options;
    keywords.take("use_names", options.useNames);
    keywords.finish();
    animation::HumanoidMap map;
    auto character = withoutGil([&] {
        auto read = animation::importCharacter(model, import);
        if (read) map = animation::mapHumanoid(read.value(), options);
        return read;
    });
    heedSignals();
    const animation::Character whole = orRaise(std::move(character));
    return mapObject(whole.skeleton, map);
}

RagdollObject build(const std::filesystem::path& model, const py::kwargs& given) {
    Keywords keywords("build", given);
    const scene::LoadOptions options = loadOptions(keywords);
    keywords.finish();
    auto loaded = withoutGil([&] { return scene::loadRagdoll(model, options); });
    heedSignals();
    return {orRaise(std::move(loaded))};
}

// The same character with another profile: no file is read.
RagdollObject withProfile(const RagdollObject& ragdoll, const ProfileObject& profile) {
    scene::LoadOptions options;
    options.given = profile.get();
    auto made = withoutGil([&] { return scene::makeRagdoll(ragdoll.asset->character, options); });
    return {orRaise(std::move(made))};
}

struct MeshObject {
    RagdollObject ragdoll;
    std::size_t index = 0;
    [[nodiscard]] const animation::SkinnedMesh& get() const { return ragdoll.asset->character.meshes[index]; }
};

std::vector<MeshObject> meshesOf(const RagdollObject& ragdoll) {
    std::vector<MeshObject> meshes;
    for (std::size_t i = 0; i < ragdoll.asset->character.meshes.size(); ++i)
        meshes.push_back({ragdoll, i});
    return meshes;
}

py::array positionsOf(const py::object& self) {
    const auto& positions = self.cast<const MeshObject&>().get().positions;
    static_assert(sizeof(vec3) == 3 * sizeof(float));
    return viewOf(positions.data(), {static_cast<py::ssize_t>(positions.size()), 3}, self);
}

py::array trianglesOf(const py::object& self) {
    const auto& indices = self.cast<const MeshObject&>().get().indices;
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(indices.size() / 3), 3};
    py::array_t<std::uint32_t> array(shape, indices.data(), self);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// The doctor's word, in Python's own values.
struct CheckupObject {
    float score = 0.0F;
    bool sound = false;
    std::vector<physics::Finding> findings;
    std::string text;
    std::string json;
};

CheckupObject check(const RagdollObject& ragdoll) {
    const scene::RagdollAsset& asset = *ragdoll.asset;
    return withoutGil([&] {
        scene::Checkup checkup = scene::examine(asset);
        return CheckupObject{checkup.score, !checkup.diagnosis.hasErrors(), checkup.diagnosis.findings,
                             scene::checkupText(asset, checkup), scene::checkupJson(asset, checkup)};
    });
}

std::shared_ptr<ProfileObject> mended(const RagdollObject& ragdoll) {
    const scene::RagdollAsset& asset = *ragdoll.asset;
    const physics::Diagnosis diagnosis = physics::diagnose(asset.profile, asset.character, asset.map);
    return std::make_shared<ProfileObject>(
        orRaise(physics::applyMends(asset.profile, asset.character, asset.map, diagnosis.findings)));
}

std::vector<std::string> exportRagdoll(const RagdollObject& ragdoll, const std::filesystem::path& file,
                                       const std::optional<std::string>& name) {
    const auto format = name ? exporting::exportFormatNamed(*name) : exporting::exportFormatOf(file);
    if (!format) {
        std::string known;
        for (const exporting::ExportFormatInfo& info : exporting::exportFormats())
            known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", info.name, info.ending);
        raise({ErrorCode::usage, name ? fmt::format("there is no format '{}'", *name) : "the ending names no format",
               file.string(), "one of " + known});
    }
    const scene::RagdollAsset& asset = *ragdoll.asset;
    keepModel(file, asset.character.file);
    auto exported = withoutGil([&]() -> Result<exporting::Exported> {
        auto made = exporting::exportRagdoll(*format, {asset.character, asset.profile, asset.rig});
        if (!made) return made;
        if (auto written = writeFileAtomically(file, made.value().bytes); !written) return written.error();
        return made;
    });
    return readable(orRaise(std::move(exported)).warnings);
}

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const exporting::ExportFormatInfo& info : exporting::exportFormats())
        names.emplace_back(info.name);
    return names;
}

void bindFacts(py::module_& module) {
    py::class_<BindingObject> binding(module, "Binding", py::is_final(), "One role's joint.");
    neverMadeByItself(binding, "a Binding is a part of a Map: map(model).roles");
    binding.def_readonly("joint", &BindingObject::joint, "The joint's name.")
        .def_readonly("path", &BindingObject::path, "Names from the root, joined by '/'.")
        .def_readonly("confidence", &BindingObject::confidence, "In [0, 1].")
        .def_readonly("reason", &BindingObject::reason, "Why, in words.")
        .def("__repr__", [](const BindingObject& b) {
            return fmt::format("<lutka.Binding {}, {:.0f}% sure>", b.joint, b.confidence * 100.0F);
        });
    py::class_<MapObject> found(module, "Map", py::is_final(), "Which joint plays which part.");
    neverMadeByItself(found, "map(model) gives a Map");
    found.def_readonly("humanoid", &MapObject::humanoid, "Whether it is one; else `warnings` says why not.")
        .def_readonly("confidence", &MapObject::confidence, "In [0, 1], of the whole.")
        .def_readonly("roles", &MapObject::roles, "VRM's name of a part to its Binding.")
        .def_readonly("missing", &MapObject::missing, "Required parts without a joint.")
        .def_readonly("warnings", &MapObject::warnings, "A sentence each.")
        .def("__repr__", [](const MapObject& m) {
            return fmt::format("<lutka.Map of {} roles, {:.0f}% sure>", m.roles.size(), m.confidence * 100.0F);
        });
    py::class_<physics::Finding> finding(module, "Finding", py::is_final(), "What the ragdoll doctor found.");
    neverMadeByItself(finding, "a Finding is a part of a Checkup: check(ragdoll).findings");
    finding
        .def_property_readonly(
            "severity", [](const physics::Finding& f) { return physics::severityName(f.severity); },
            "'error', 'warning' or 'info'.")
        .def_readonly("code", &physics::Finding::code, "Which check.")
        .def_readonly("place", &physics::Finding::place, "Bodies, or a JSON pointer into the profile.")
        .def_readonly("measure", &physics::Finding::measure, "The figure and its bound.")
        .def_readonly("mend", &physics::Finding::mend, "What to do about it.")
        .def_readonly("mendable", &physics::Finding::mendable, "Whether Ragdoll.mended() does it.")
        .def_readonly("bodies", &physics::Finding::bodies, "Names of those concerned.")
        .def("__repr__", [](const physics::Finding& f) {
            return fmt::format("<lutka.Finding {} {} at {}>", physics::severityName(f.severity), f.code, f.place);
        });
    py::class_<CheckupObject> checkup(module, "Checkup", py::is_final(),
                                      "The ragdoll doctor's word; str() gives it as `lutka check` prints it.");
    neverMadeByItself(checkup, "check(ragdoll) gives a Checkup");
    checkup.def_readonly("score", &CheckupObject::score, "In [0, 100].")
        .def_readonly("sound", &CheckupObject::sound, "Whether no finding is an error.")
        .def_readonly("findings", &CheckupObject::findings, "Errors first.")
        .def(
            "facts", [](const CheckupObject& c) { return fromJson(c.json); },
            "Everything, as `lutka check --json` has it.")
        .def("__str__", [](const CheckupObject& c) { return readable(c.text); })
        .def("__repr__", [](const CheckupObject& c) {
            return fmt::format("<lutka.Checkup: {:.0f} of 100, {} findings>", c.score, c.findings.size());
        });
}

void bindMesh(py::module_& module) {
    py::class_<MeshObject> mesh(module, "Mesh", py::is_final(),
                                "A mesh of the character in its bind pose, model space, metres.");
    neverMadeByItself(mesh, "a Mesh is a part of a Ragdoll: ragdoll.meshes");
    mesh.def_property_readonly(
            "name", [](const MeshObject& m) { return readable(m.get().name); }, "As the file has it.")
        .def_property_readonly("positions", &positionsOf, "(vertices, 3) floats: a read-only view.")
        .def_property_readonly("triangles", &trianglesOf, "(triangles, 3) indices of vertices: a read-only view.");
}

}  // namespace

void bindRagdoll(py::module_& module) {
    bindFacts(module);
    bindMesh(module);
    py::class_<RagdollObject> ragdoll(module, "Ragdoll", py::is_final(),
                                      "A character with its ragdoll. Never changes; simulations share it.");
    neverMadeByItself(ragdoll, "build(model) gives a Ragdoll");
    ragdoll
        .def_property_readonly(
            "profile", [](const RagdollObject& r) { return std::make_shared<ProfileObject>(r.asset->profile); },
            "A copy of the profile, to be edited and given to with_profile().")
        .def("with_profile", &withProfile, py::arg("profile"), "The same character with that profile.")
        .def("mended", &mended, "The profile with what the doctor can mend mended.")
        .def_property_readonly(
            "map", [](const RagdollObject& r) { return mapObject(r.asset->character.skeleton, r.asset->map); },
            "Which joint plays which part, as lutka.map() gives it.")
        .def_property_readonly(
            "model", [](const RagdollObject& r) { return r.asset->character.file; }, "The file it came from.")
        .def_property_readonly(
            "joints", [](const RagdollObject& r) { return readable(r.asset->character.skeleton.names); },
            "Names of the skeleton's joints, in the order of poses.")
        .def_property_readonly(
            "joint_parents", [](const RagdollObject& r) { return r.asset->character.skeleton.parents; },
            "Index of each joint's parent; -1 for roots.")
        .def_property_readonly(
            "bodies",
            [](const RagdollObject& r) {
                std::vector<std::string> names;
                for (const physics::BodyProfile& body : r.asset->profile.bodies)
                    names.push_back(body.name);
                return names;
            },
            "Names of the bodies, in the order of Simulation.bodies.")
        .def_property_readonly(
            "clips",
            [](const RagdollObject& r) {
                std::vector<std::string> names;
                for (const animation::Clip& clip : r.asset->character.clips)
                    names.push_back(readable(clip.name));
                return names;
            },
            "Names of the model's animations.")
        .def_property_readonly("meshes", &meshesOf, "The skin, a Mesh each; they keep the ragdoll alive.")
        .def_property_readonly(
            "warnings",
            [](const RagdollObject& r) {
                std::vector<std::string> all = readable(r.asset->character.warnings);
                for (const std::string& warning : readable(r.asset->map.warnings))
                    all.push_back(warning);
                return all;
            },
            "What was repaired, dropped or guessed, a sentence each.")
        .def_property_readonly(
            "from_model", [](const RagdollObject& r) { return r.asset->fromModel; },
            "Whether the model's own file brought the ragdoll along.")
        .def_property_readonly(
            "rebound", [](const RagdollObject& r) { return r.asset->rebound; },
            "Whether the profile was made for another rig and bound by role.")
        .def("__repr__", [](const RagdollObject& r) {
            return fmt::format("<lutka.Ragdoll of {}: {} bodies>", readable(r.asset->character.name),
                               r.asset->profile.bodies.size());
        });
    module.def("map", &map, py::arg("model"), "Which joint of a model plays which part of a humanoid.");
    module.def("build", &build, py::arg("model"),
               "Reads a model and makes its ragdoll: map, fit, masses, limits, filter.");
    module.def("check", &check, py::arg("ragdoll"), "Examines a ragdoll: findings, three drops, a score.");
    module.def(
        "export", &exportRagdoll, py::arg("ragdoll"), py::arg("file"), py::arg("format") = py::none(),
        "Writes the ragdoll in another engine's format (docs/export.md), by the file's ending unless `format` names "
        "it. Returns what the format can't hold, a sentence each.");
    module.attr("export_formats") = py::tuple(py::cast(formatNames()));
}

}  // namespace lutka::python
