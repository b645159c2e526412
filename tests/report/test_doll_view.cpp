#include "report/doll_view.hpp"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "animation/skinning.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::reporting;

namespace {

template <class T>
std::vector<T> unpacked(const nlohmann::ordered_json& json) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : json.get<std::string>()) {
        if (c == '=') break;
        bits = bits << 6U | static_cast<std::uint32_t>(kDigits.find(c));
        held += 6;
        if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 0xFFU);
    }
    REQUIRE(bytes.size() % sizeof(T) == 0);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

// A fall of half a second.
DropTrace shortFall(const scene::RagdollAsset& asset) {
    auto scenario = scene::makeScenario({.name = "drop", .seed = 1}, asset);
    REQUIRE(scenario);
    const auto simulation = scene::Simulation::create(asset, std::move(scenario).value(), {});
    REQUIRE(simulation);
    DropRecorder recorder;
    recorder.sample(*simulation.value());
    for (int step = 0; step < 60; ++step) {
        simulation.value()->step();
        recorder.sample(*simulation.value());
    }
    return recorder.trace();
}

RigidTransform transformAt(const std::vector<float>& values, std::size_t index) {
    const float* v = values.data() + index * 7;
    return {quat(v[6], v[3], v[4], v[5]), vec3(v[0], v[1], v[2])};
}

}  // namespace

TEST_CASE("the view's tracks and weights skin the doll as the reference does") {
    const auto asset = test::bipedRagdoll();
    const std::vector<DropTrace> drops = {shortFall(*asset)};
    const nlohmann::ordered_json json = dollViewJson(*asset, drops);
    const auto& skeleton = asset->character.skeleton;
    const auto tracks = unpacked<float>(json["drops"][0]["tracks"]);
    const int poses = drops[0].poses;
    const std::size_t trackCount = tracks.size() / 7 / static_cast<std::size_t>(poses);
    const std::size_t last = static_cast<std::size_t>(poses) - 1;
    const std::span worldFromJoint(drops[0].worldFromJoint.data() + last * skeleton.parents.size(),
                                   skeleton.parents.size());
    std::vector<animation::SkinMatrix> palette(skeleton.parents.size());
    animation::skinMatrices(skeleton.bindModelFromJoint, worldFromJoint, palette);
    REQUIRE(json["meshes"].size() == asset->character.meshes.size());
    for (std::size_t m = 0; m < asset->character.meshes.size(); ++m) {
        const animation::SkinnedMesh& mesh = asset->character.meshes[m];
        std::vector<vec3> expected(mesh.positions.size());
        animation::skinVertices(mesh, palette, expected, {});
        const auto positions = unpacked<float>(json["meshes"][m]["positions"]);
        const auto joints = unpacked<std::uint16_t>(json["meshes"][m]["tracks"]);
        const auto weights = unpacked<std::uint8_t>(json["meshes"][m]["weights"]);
        REQUIRE(positions.size() == 3 * expected.size());
        CHECK(unpacked<std::uint32_t>(json["meshes"][m]["indices"]) == mesh.indices);
        for (std::size_t v = 0; v < expected.size(); ++v) {
            vec3 skinned(0);
            int sum = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                sum += weights[4 * v + i];
                const vec3 bind(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
                const RigidTransform moved = transformAt(tracks, last * trackCount + joints[4 * v + i]);
                skinned += (moved * bind) * (static_cast<float>(weights[4 * v + i]) / 255.0F);
            }
            CHECK(sum == 255);
            CHECK(glm::distance(skinned, expected[v]) < 0.004F);
        }
    }
}

TEST_CASE("joints that move their skin alike share a track") {
    const auto asset = test::bipedRagdoll();
    std::set<int> used;
    for (const animation::SkinnedMesh& mesh : asset->character.meshes) {
        for (std::size_t v = 0; v < mesh.joints.size(); ++v) {
            for (std::size_t i = 0; i < 4; ++i) {
                if (mesh.weights[v][i] > 0) used.insert(mesh.joints[v][i]);
            }
        }
    }
    REQUIRE(used.size() > 2);
    const std::vector<DropTrace> falling = {shortFall(*asset)};
    const std::vector<DropTrace> standing = {standingTrace(*asset)};
    const auto tracksOf = [&](const std::vector<DropTrace>& drops) {
        const auto json = dollViewJson(*asset, drops);
        return unpacked<float>(json["drops"][0]["tracks"]).size() / 7 / static_cast<std::size_t>(drops[0].poses);
    };
    CHECK(tracksOf(falling) <= used.size());
    CHECK(tracksOf(falling) >= asset->profile.bodies.size() / 2);
    CHECK(tracksOf(standing) == 1);  // nothing has moved
}

TEST_CASE("bodies and constraints go into the view as the profile has them") {
    const auto asset = test::bipedRagdoll();
    const std::vector<DropTrace> drops = {standingTrace(*asset)};
    const auto json = dollViewJson(*asset, drops);
    REQUIRE(json["bodies"].size() == asset->profile.bodies.size());
    REQUIRE(json["constraints"].size() == asset->profile.constraints.size());
    for (std::size_t i = 0; i < asset->profile.constraints.size(); ++i) {
        const auto& constraint = asset->profile.constraints[i];
        const bool hinge = constraint.kind == physics::ConstraintProfile::Kind::hinge;
        CHECK(json["constraints"][i].contains(hinge ? "hinge" : "cone"));
        CHECK(json["constraints"][i]["child"] == constraint.child);
    }
    CHECK(unpacked<float>(json["drops"][0]["bodies"]).size() == 7 * asset->profile.bodies.size());
}

TEST_CASE("the view knows how far the skin reaches, and has room for what stands out") {
    const auto asset = test::bipedRagdoll();
    const std::vector<DropTrace> drops = {shortFall(*asset)};
    const float before = dollViewJson(*asset, drops)["reachM"].get<float>();
    CHECK(before > 0.4F * asset->profile.heightM);
    CHECK(before < asset->profile.heightM);
    std::vector<vec3>& skin = asset->character.meshes.front().positions;
    std::max_element(skin.begin(), skin.end(), [](const vec3& a, const vec3& b) { return a.y < b.y; })->y += 2.0F;
    CHECK(dollViewJson(*asset, drops)["reachM"].get<float>() == Approx(before + 2.0F).margin(0.25));
}
