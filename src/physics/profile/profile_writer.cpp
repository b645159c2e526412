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

Json shape(const BodyShape& s) {
    switch (s.kind) {
        case BodyShape::Kind::capsule:
            return Json{
                {"kind", "capsule"}, {"radius", jsonNumber(s.radius)}, {"halfLength", jsonNumber(s.halfLength)}};
        case BodyShape::Kind::sphere:
            return Json{{"kind", "sphere"}, {"radius", jsonNumber(s.radius)}};
        case BodyShape::Kind::box:
            break;
    }
    return Json{{"kind", "box"}, {"halfExtents", jsonVector(s.halfExtents)}};
}

Json body(const BodyProfile& b) {
    return Json{{"role", roleName(b.role)},
                {"joint", b.joint},
                {"jointPath", b.jointPath},
                {"shape", shape(b.shape)},
                {"jointFromBody", frame(b.jointFromBody)},
                {"massKg", jsonNumber(b.massKg)},
                {"inertia", jsonVector(b.inertia)}};
}

Json constraint(const RagdollProfile& profile, const ConstraintProfile& c) {
    const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
    Json out{{"child", roleName(profile.bodies[c.child].role)},
             {"parent", roleName(profile.bodies[c.parent].role)},
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
    out["bodies"] = Json::array();
    for (const BodyProfile& b : profile.bodies)
        out["bodies"].push_back(body(b));
    out["constraints"] = Json::array();
    for (const ConstraintProfile& c : profile.constraints)
        out["constraints"].push_back(constraint(profile, c));
    out["filteredPairs"] = Json::array();
    for (const auto& [first, second] : profile.filteredPairs) {
        out["filteredPairs"].push_back(
            Json::array({roleName(profile.bodies[first].role), roleName(profile.bodies[second].role)}));
    }
    out["notes"] = profile.notes;
    return jsonText(out);
}

Result<void> saveProfile(const std::filesystem::path& file, const RagdollProfile& profile) {
    return writeFileAtomically(file, profileToJson(profile));
}

}  // namespace lutka::physics
