#include <chrono>
#include <cstdio>
#include <functional>
#include <glm/gtc/quaternion.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "animation/import/import_character.hpp"
#include "rig_variations.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"
#include "zoo_scoring.hpp"

namespace lutka::test {
namespace {

using animation::Character;

struct Model {
    Truth truth;
    Character character;
};

// Every model of the folder, loaded once. A file that can't be read is the importer's affair and left out here.
const std::vector<Model>& zoo() {
    static const std::vector<Model> models = [] {
        std::vector<Model> loaded;
        for (Truth& truth : readTruths(LUTKA_ZOO_DIR)) {
            animation::ImportOptions options;
            options.loadTextures = false;
            // Its truth is that Assimp reads no joint of it (a refusal); our reader does.
            if (truth.model == "iqm_guy_noskin") continue;
            auto character = animation::importCharacter(truth.file, options);
            if (!character && truth.humanoid) {
                std::printf("left out: %s\n", character.error().text().c_str());
                continue;
            }
            loaded.push_back({std::move(truth), character ? std::move(character.value()) : Character{}});
        }
        return loaded;
    }();
    return models;
}

using Variation = std::function<Character(const Character&)>;

struct Totals {
    Score score;
    int falselyAccepted = 0;
};

// Block men whose front and back are alike, or that only their soles tell apart: without names their sides are
// anybody's guess, and names that agree everywhere outweigh a single measure.
bool sidesAreUnknown(const Model& model) {
    return model.truth.model == "minetest_character" || model.truth.model == "hl1_man" ||
           model.truth.model == "sketchbook_boxman";
}

enum class Sides { asNamed, unnamed, againstNames };

Totals scoreAll(const char* title, const Variation& vary, Sides sides = Sides::asNamed) {
    Totals totals;
    std::printf("\n%s\n", title);
    for (const Model& model : zoo()) {
        const Character character = vary(model.character);
        const auto start = std::chrono::steady_clock::now();
        const animation::HumanoidMap map = animation::mapHumanoid(character);
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        const Truth truth = sides == Sides::againstNames ? mirrorTruth(model.truth) : model.truth;
        Score score = scoreMap(truth, map, model.character.skeleton.names);
        if (sides != Sides::asNamed && sidesAreUnknown(model)) {
            const Score other = scoreMap(mirrorTruth(truth), map, model.character.skeleton.names);
            if (other.right > score.right) score = other;
        }
        std::printf("  %-30s %3d joints %6.1f ms  required %2d/%2d  optional %d/%d  confidence %.2f  %s\n",
                    model.truth.model.c_str(), character.skeleton.jointCount(), spent.count(), score.right, score.of,
                    score.optionalRight, score.optionalOf, static_cast<double>(map.confidence), score.faults.c_str());
        if (!map.humanoid && !map.warnings.empty()) std::printf("      %s\n", map.warnings.front().c_str());
        totals.score += score;
        if (!model.truth.humanoid && map.humanoid) ++totals.falselyAccepted;
    }
    std::printf("  all: required %d/%d (%.1f %%), optional %d/%d\n", totals.score.right, totals.score.of,
                100.0 * totals.score.right / totals.score.of, totals.score.optionalRight, totals.score.optionalOf);
    return totals;
}

quat aboutY(float angle) {
    return glm::angleAxis(angle, vec3(0, 1, 0));
}

quat zUp() {
    return glm::angleAxis(radians(90.0F), vec3(1, 0, 0));
}

void requireNamed(const Totals& totals) {
    CHECK(totals.falselyAccepted == 0);
    CHECK(totals.score.right == totals.score.of);
}

void requireUnnamed(const Totals& totals) {
    CHECK(totals.falselyAccepted == 0);
    CHECK(static_cast<double>(totals.score.right) >= 0.95 * totals.score.of);
}

}  // namespace

TEST_CASE("every test model maps to its truth", "[zoo]") {
    NEEDS_ZOO();
    requireNamed(scoreAll("as they are", [](const Character& c) { return c; }));
}

TEST_CASE("test models map without any names", "[zoo]") {
    NEEDS_ZOO();
    requireUnnamed(scoreAll(
        "all joints named joint_N", [](const Character& c) { return withoutNames(c); }, Sides::unnamed));
}

TEST_CASE("turned about the vertical test models keep their roles", "[zoo]") {
    NEEDS_ZOO();
    const quat turn = aboutY(radians(37.0F));
    requireNamed(scoreAll("turned by 37 degrees", [&](const Character& c) { return rotated(c, turn); }));
    requireUnnamed(scoreAll(
        "turned by 37 degrees, joint_N", [&](const Character& c) { return rotated(withoutNames(c), turn); },
        Sides::unnamed));
}

TEST_CASE("with Z up test models keep their roles", "[zoo]") {
    NEEDS_ZOO();
    requireNamed(scoreAll("Z up", [](const Character& c) { return rotated(c, zUp()); }));
    requireUnnamed(scoreAll(
        "Z up, joint_N", [](const Character& c) { return rotated(withoutNames(c), zUp()); }, Sides::unnamed));
}

TEST_CASE("at any scale test models keep their roles", "[zoo]") {
    NEEDS_ZOO();
    for (const float factor : {0.01F, 100.0F}) {
        requireNamed(scoreAll("scaled", [&](const Character& c) { return scaled(c, factor); }));
        requireUnnamed(scoreAll(
            "scaled, joint_N", [&](const Character& c) { return scaled(withoutNames(c), factor); }, Sides::unnamed));
    }
}

TEST_CASE("mirror images of test models exchange left and right", "[zoo]") {
    NEEDS_ZOO();
    requireNamed(scoreAll(
        "mirrored", [](const Character& c) { return mirrorImage(c); }, Sides::againstNames));
    requireUnnamed(scoreAll(
        "mirrored, joint_N", [](const Character& c) { return mirrorImage(withoutNames(c)); }, Sides::againstNames));
}

TEST_CASE("joints and weights alone are enough in whatever pose the nodes have", "[zoo]") {
    NEEDS_ZOO();
    std::printf("\njoints of bones.txt\n");
    Score named;
    Score unnamed;
    for (const Model& model : zoo()) {
        const Character character = readBones(model.truth);
        // Block men need their skin: without it a limb of one joint has no length.
        const auto& elbow = model.truth.roles[indexOf(animation::Role::leftLowerArm)];
        const bool blocky = elbow && elbow->front().empty();
        if (character.skeleton.jointCount() == 0 || !model.truth.humanoid || blocky) continue;
        for (const bool names : {true, false}) {
            const auto map = animation::mapHumanoid(names ? character : withoutNames(character));
            const Score score = scoreMap(model.truth, map, character.skeleton.names);
            std::printf("  %-30s %s  required %2d/%2d  optional %d/%d  %s\n", model.truth.model.c_str(),
                        names ? "named  " : "unnamed", score.right, score.of, score.optionalRight, score.optionalOf,
                        score.faults.c_str());
            (names ? named : unnamed) += score;
        }
    }
    std::printf("  all: named %d/%d, unnamed %d/%d\n", named.right, named.of, unnamed.right, unnamed.of);
    CHECK(named.right >= 0.95 * named.of);
    CHECK(unnamed.right >= 0.9 * unnamed.of);
}

}  // namespace lutka::test
