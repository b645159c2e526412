#include "scene/draw/film_camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/draw/scene_extent.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

constexpr render::Extent kFilm{960, 540};
constexpr float kFramesPerSecond = 30.0F;

std::unique_ptr<Simulation> simulationOf(const RagdollAsset& asset, std::string_view name, int count = 1) {
    auto scenario = makeScenario({.name = name, .count = count, .seed = 0}, asset);
    REQUIRE(scenario.ok());
    auto made = Simulation::create(asset, std::move(scenario).value(), {});
    REQUIRE(made.ok());
    return std::move(made).value();
}

// Whether a solid box stands between two points.
bool hides(const Scenario& scenario, const vec3& from, const vec3& to) {
    for (std::size_t i = 0; i < scenario.statics.size(); ++i) {
        const physics::StaticShape& shape = scenario.statics[i];
        if (shape.kind != physics::StaticShape::Kind::box || scenario.staticLooks[i].color.a < 128) continue;
        const RigidTransform shapeFromWorld = inverse(shape.worldFromShape);
        const vec3 start = shapeFromWorld * from;
        const vec3 way = shapeFromWorld * to - start;
        float enter = 0.0F;
        float leave = 1.0F;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = (-shape.halfExtents[axis] - start[axis]) / way[axis];
            const float b = (shape.halfExtents[axis] - start[axis]) / way[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (enter < leave) return true;
    }
    return false;
}

vec3 middleOf(std::span<const RigidTransform> bodies) {
    vec3 middle(0);
    for (const RigidTransform& body : bodies)
        middle += body.translation / static_cast<float>(bodies.size());
    return middle;
}

}  // namespace

TEST_CASE("the camera of every named scene follows the doll, near enough, and nothing stands between them") {
    const auto asset = test::bipedRagdoll();
    for (const ScenarioInfo& info : scenarioRegistry()) {
        INFO(info.name);
        const auto simulation = simulationOf(*asset, info.name);
        FilmCamera film(simulation->scenario(), kFilm.aspect());
        film.update(*simulation, 1.0F, 0.0F);
        int hidden = 0;
        int pictures = 0;
        const int frames = static_cast<int>(simulation->scenario().seconds * kFramesPerSecond);
        for (int frame = 0; frame < frames; ++frame) {
            simulation->step();
            simulation->step();
            film.update(*simulation, 1.0F, 1.0F / kFramesPerSecond);
            const auto bodies = simulation->worldFromBody(0);
            const float pictureHeight = 2.0F * film.camera.distance * std::tan(0.5F * film.camera.fieldOfView);
            const float share = asset->profile.heightM / pictureHeight;
            REQUIRE(share > 1.0F / 3.0F);
            REQUIRE(share < (frame == 0 ? 0.5F : 0.81F));  // nearer to one that lies
            for (const RigidTransform& body : bodies) {
                const auto seen = render::project(film.camera, body.translation, kFilm);
                REQUIRE(seen.has_value());
                REQUIRE((seen->x > 0 && seen->x < kFilm.width && seen->y > 0 && seen->y < kFilm.height));
            }
            ++pictures;
            if (hides(simulation->scenario(), render::eyeOf(film.camera), middleOf(bodies))) ++hidden;
        }
        CHECK(hidden < pictures / 20);
    }
}

TEST_CASE("the camera comes nearer to a doll that lies, never by a leap, and shows all of it") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = simulationOf(*asset, "drop");
    FilmCamera film(simulation->scenario(), kFilm.aspect());
    film.update(*simulation, 1.0F, 0.0F);
    const float standing = film.camera.distance;
    float before = standing;
    float largestStep = 0.0F;
    for (int frame = 0; frame < 6 * static_cast<int>(kFramesPerSecond); ++frame) {
        simulation->step();
        simulation->step();
        film.update(*simulation, 1.0F, 1.0F / kFramesPerSecond);
        largestStep = std::max(largestStep, std::abs(film.camera.distance - before) / before);
        before = film.camera.distance;
    }
    CHECK(film.camera.distance < 0.75F * standing);
    CHECK(largestStep < 0.03F);
    std::vector<vec3> points;
    addExtentOfDoll(*simulation, 0, 1.0F, points);
    for (const vec3& point : points) {
        const auto seen = render::project(film.camera, point, kFilm);
        REQUIRE(seen.has_value());
        CHECK((seen->x > 0 && seen->x < kFilm.width && seen->y > 0 && seen->y < kFilm.height));
    }
}

TEST_CASE("a doll that is followed stays whole in the picture, horns and all") {
    const auto asset = test::bipedRagdoll();
    std::vector<vec3>& skin = asset->character.meshes.front().positions;
    vec3& horn = *std::max_element(skin.begin(), skin.end(), [](const vec3& a, const vec3& b) { return a.y < b.y; });
    horn.y += 0.9F;
    const int head = physics::bodyOf(asset->profile, physics::Role::head);
    const vec3 inHead = inverse(asset->rig.bindModelFromBody[head]) * horn;
    const auto simulation = simulationOf(*asset, "drop");
    FilmCamera film(simulation->scenario(), kFilm.aspect());
    film.followDoll(0);
    film.update(*simulation, 1.0F, 0.0F);
    for (int frame = 0; frame < 4 * static_cast<int>(kFramesPerSecond); ++frame) {
        simulation->step();
        simulation->step();
        film.update(*simulation, 1.0F, 1.0F / kFramesPerSecond);
        const auto seen = render::project(film.camera, simulation->worldFromBody(0)[head] * inHead, kFilm);
        INFO(frame);
        REQUIRE(seen.has_value());
        REQUIRE((seen->x > 0 && seen->x < kFilm.width && seen->y > 0 && seen->y < kFilm.height));
    }
}

TEST_CASE("a film of several dolls has them all in the picture, also where some walk on and some lie behind") {
    const auto asset = test::bipedRagdoll();
    for (const ScenarioInfo& info : scenarioRegistry()) {
        INFO(info.name);
        const auto simulation = simulationOf(*asset, info.name, 9);
        FilmCamera film(simulation->scenario(), kFilm.aspect());
        film.update(*simulation, 1.0F, 0.0F);
        const int frames = static_cast<int>(simulation->scenario().seconds * kFramesPerSecond);
        std::vector<vec3> points;
        int cutOff = 0;
        for (int frame = 0; frame < frames; ++frame) {
            simulation->step();
            simulation->step();
            film.update(*simulation, 1.0F, 1.0F / kFramesPerSecond);
            points.clear();
            for (int doll = 0; doll < simulation->dollCount(); ++doll)
                addExtentOfDoll(*simulation, doll, 1.0F, points);
            for (const vec3& point : points) {
                const auto seen = render::project(film.camera, point, kFilm);
                if (!seen || seen->x < 0 || seen->x > kFilm.width || seen->y < 0 || seen->y > kFilm.height) ++cutOff;
            }
        }
        CHECK(cutOff == 0);
    }
}

TEST_CASE("a scene's own camera stays where the scene has it") {
    const auto asset = test::bipedRagdoll();
    auto scenario = makeScenario({.name = "drop"}, *asset);
    REQUIRE(scenario.ok());
    scenario.value().camera = render::Camera{};
    scenario.value().camera->distance = 7.0F;
    auto simulation = Simulation::create(*asset, std::move(scenario).value(), {});
    REQUIRE(simulation.ok());
    FilmCamera film(simulation.value()->scenario(), kFilm.aspect());
    film.update(*simulation.value(), 1.0F, 0.0F);
    CHECK(film.camera.distance == 7.0F);
    film.followDoll(0);
    film.update(*simulation.value(), 1.0F, 0.0F);
    CHECK(film.camera.distance < 7.0F);
}

TEST_CASE("the extent of a scene holds its dolls, its walls and the ground below them") {
    const auto asset = test::bipedRagdoll();
    const auto simulation = simulationOf(*asset, "throw");
    std::vector<vec3> points;
    addExtentOfScene(*simulation, 1.0F, points);
    vec3 low(1e9F);
    vec3 high(-1e9F);
    for (const vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    CHECK(high.y == Approx(3.0F).margin(0.01));  // the wall's height
    CHECK(high.z == Approx(2.025F).margin(0.01));
    CHECK(low.y == Approx(0.0F).margin(0.01));
    for (const RigidTransform& body : simulation->worldFromBody(0))
        CHECK((body.translation.z > low.z && body.translation.z < high.z));
}

TEST_CASE("what a figure wears and carries is in the picture as well: capes, wings and scythes") {
    const auto asset = test::bipedRagdoll();
    const auto plain = simulationOf(*asset, "drop");
    FilmCamera before(plain->scenario(), kFilm.aspect());
    before.update(*plain, 1.0F, 0.0F);
    std::vector<vec3>& skin = asset->character.meshes.front().positions;
    vec3& blade = *std::max_element(skin.begin(), skin.end(), [](const vec3& a, const vec3& b) { return a.y < b.y; });
    blade += vec3(0, 1.6F, 0.9F);
    const auto simulation = simulationOf(*asset, "drop");
    std::vector<vec3> points;
    addExtentOfDoll(*simulation, 0, 1.0F, points);
    const auto highest = [](const std::vector<vec3>& all) {
        return std::max_element(all.begin(), all.end(), [](const vec3& a, const vec3& b) { return a.y < b.y; })->y;
    };
    std::vector<vec3> bodies;
    addExtentOfDoll(*plain, 0, 1.0F, bodies);
    CHECK(highest(points) > highest(bodies) + 0.5F);
    FilmCamera film(simulation->scenario(), kFilm.aspect());
    film.update(*simulation, 1.0F, 0.0F);
    CHECK(film.camera.distance > before.camera.distance);
    const auto shows = [&](const vec3& point) {
        const auto seen = render::project(film.camera, point, kFilm);
        return seen && seen->x > 0 && seen->x < kFilm.width && seen->y > 0 && seen->y < kFilm.height;
    };
    CHECK(std::all_of(points.begin(), points.end(), shows));
    for (int frame = 0; frame < 4 * static_cast<int>(kFramesPerSecond); ++frame) {
        simulation->step();
        simulation->step();
        film.update(*simulation, 1.0F, 1.0F / kFramesPerSecond);
    }
    points.clear();
    addExtentOfDoll(*simulation, 0, 1.0F, points);
    CHECK(std::all_of(points.begin(), points.end(), shows));
}
