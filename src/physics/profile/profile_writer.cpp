#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "core/json/json_text.hpp"
#include "physics/profile/profile_format.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::physics {
namespace {

using Json = nlohmann::ordered_json;

Json frame(const RigidTransform& t) {
    return Json{{"rotation", jsonQuaternion(t.rotation)}, {"translation", jsonVector(t.translation)}};
}

Json primitive(const PrimitiveShape& s) {
    switch (s.kind) {
        case PrimitiveShape::Kind::capsule:
            return Json{
                {"kind", "capsule"}, {"radius", jsonNumber(s.radius)}, {"halfLength", jsonNumber(s.halfLength)}};
        case PrimitiveShape::Kind::sphere:
            return Json{{"kind", "sphere"}, {"radius", jsonNumber(s.radius)}};
        case PrimitiveShape::Kind::hull: {
            Json points = Json::array();
            for (const vec3& point : s.hull->points())
                points.push_back(jsonVector(point));
            return Json{{"kind", "hull"}, {"points", std::move(points)}};
        }
        case PrimitiveShape::Kind::box:
            break;
    }
    return Json{{"kind", "box"}, {"halfExtents", jsonVector(s.halfExtents)}};
}

Json shape(const BodyShape& s) {
    Json out = primitive(s);
    for (const AddedShape& added : s.more) {
        Json one = primitive(added);
        one["bodyFromShape"] = frame(added.bodyFromShape);
        out["more"].push_back(std::move(one));
    }
    return out;
}

Json factors(const MuscleFactors& f) {
    return Json{
        {"strength", jsonNumber(f.strength)}, {"damping", jsonNumber(f.damping)}, {"torque", jsonNumber(f.torque)}};
}

Json muscles(const MuscleProfile& m) {
    Json out{{"frequencyHz", jsonNumber(m.frequencyHz)},
             {"dampingRatio", jsonNumber(m.dampingRatio)},
             {"strength", jsonNumber(m.strength)},
             {"torque", jsonNumber(m.torque)},
             {"bounded", m.bounded},
             {"carriesGravity", m.carriesGravity},
             {"groups", Json::object()}};
    for (std::size_t group = 0; group < m.groups.size(); ++group)
        out["groups"][std::string(kMuscleGroupNames[group])] = factors(m.groups[group]);
    return out;
}

Json body(const BodyProfile& b) {
    Json out{{"name", b.name}};
    if (b.role) out["role"] = roleName(*b.role);
    if (!b.mirror.empty()) out["mirror"] = b.mirror;
    out["joint"] = b.joint;
    out["jointPath"] = b.jointPath;
    out["shape"] = shape(b.shape);
    out["jointFromBody"] = frame(b.jointFromBody);
    out["massKg"] = jsonNumber(b.massKg);
    out["inertia"] = jsonVector(b.inertia);
    if (!(b.muscle == MuscleFactors{})) out["muscle"] = factors(b.muscle);
    if (b.pinForceN) out["pinForceN"] = jsonNumber(*b.pinForceN);
    return out;
}

Json constraint(const RagdollProfile& profile, const ConstraintProfile& c) {
    const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
    Json out{{"child", profile.bodies[c.child].name},
             {"parent", profile.bodies[c.parent].name},
             {"kind", hinge ? "hinge" : "coneTwist"},
             {"parentFromFrame", frame(c.parentFromFrame)},
             {"childFromFrame", frame(c.childFromFrame)}};
    if (hinge) {
        out["hinge"] = Json{{"lower", jsonNumber(c.hinge.lower)}, {"upper", jsonNumber(c.hinge.upper)}};
    } else {
        out["cone"] = Json{{"swingY", jsonNumber(c.cone.swingY)},
                           {"swingZ", jsonNumber(c.cone.swingZ)},
                           {"twist", jsonNumber(c.cone.twist)}};
    }
    out["frictionNm"] = jsonNumber(c.frictionNm);
    if (c.spring.works()) {
        out["spring"] = Json{{"stiffness", jsonNumber(c.spring.stiffness)},
                             {"damping", jsonNumber(c.spring.damping)},
                             {"rest", jsonQuaternion(c.spring.rest)}};
    }
    return out;
}

}  // namespace

std::string profileToJson(const RagdollProfile& profile) {
    Json out{{"$schema", profile_format::kSchema},
             {"format", profile_format::kName},
             {"version", RagdollProfile::kVersion},
             {"units", {{"length", "m"}, {"mass", "kg"}, {"angle", "rad"}, {"torque", "N m"}}},
             {"name", profile.name},
             {"heightM", jsonNumber(profile.heightM)},
             {"totalMassKg", jsonNumber(profile.totalMassKg)},
             {"standardFromModel", jsonQuaternion(profile.standardFromModel)}};
    if (profile.muscles) out["muscles"] = muscles(*profile.muscles);
    out["bodies"] = Json::array();
    for (const BodyProfile& b : profile.bodies)
        out["bodies"].push_back(body(b));
    out["constraints"] = Json::array();
    for (const ConstraintProfile& c : profile.constraints)
        out["constraints"].push_back(constraint(profile, c));
    out["filteredPairs"] = Json::array();
    for (const auto& [first, second] : profile.filteredPairs) {
        out["filteredPairs"].push_back(Json::array({profile.bodies[first].name, profile.bodies[second].name}));
    }
    out["notes"] = profile.notes;
    return jsonText(out);
}

Result<void> saveProfile(const std::filesystem::path& file, const RagdollProfile& profile) {
    return writeFileAtomically(file, profileToJson(profile));
}

}  // namespace lutka::physics
