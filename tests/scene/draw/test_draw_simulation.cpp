#include "scene/draw/draw_simulation.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>

#include "physics/profile/constraint_state.hpp"
#include "support/catch.hpp"
#include "support/ragdolls.hpp"

using namespace lutka;
using namespace lutka::scene;

TEST_CASE("debug layers are read from a list and unknown ones are refused with those there are") {
    const auto layers = parseDebugLayers("capsules,limits");
    REQUIRE(layers);
    CHECK(layers.value().capsules);
    CHECK(layers.value().limits);
    CHECK_FALSE(layers.value().joints);
    CHECK(parseDebugLayers(""));
    const auto wrong = parseDebugLayers("capsules,cones");
    REQUIRE_FALSE(wrong);
    CHECK(wrong.error().code == ErrorCode::usage);
    CHECK(wrong.error().mend.find("contacts") != std::string::npos);
}

TEST_CASE("a frame holds every doll, the geometry and only the layers that were asked for") {
    const auto asset = test::bipedRagdoll();
    auto scenario = makeScenario({.name = "stairs", .count = 2}, *asset);
    REQUIRE(scenario);
    const auto simulation = Simulation::create(*asset, std::move(scenario).value(), {});
    REQUIRE(simulation);
    SimulationDrawer drawer;
    render::FrameDescription frame;
    drawer.draw(*simulation.value(), render::CharacterHandle{0}, {}, 1.0F, 1.0F, frame);
    CHECK(frame.characters.size() == 2);
    CHECK(frame.props.size() == 12);  // the steps; the plane is the renderer's floor
    CHECK(frame.floor.visible);
    CHECK(frame.lines.vertices.empty());
    CHECK(frame.solids.empty());

    frame.clear();
    DebugLayers layers;
    layers.capsules = true;
    drawer.draw(*simulation.value(), render::CharacterHandle{0}, layers, 1.0F, 0.0F, frame);
    CHECK(frame.characters.empty());
    CHECK_FALSE(frame.lines.vertices.empty());
    const std::size_t capsulesAlone = frame.lines.vertices.size();

    frame.clear();
    layers.limits = true;
    drawer.draw(*simulation.value(), render::CharacterHandle{0}, layers, 1.0F, 0.0F, frame);
    CHECK(frame.lines.vertices.size() > capsulesAlone);
    CHECK_FALSE(frame.solids.empty());
}

namespace {

bool sameColor(render::Color a, render::Color b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// A doll of the hand-made figure in its bind pose, with one constraint's limits to play with.
struct PosedDoll {
    std::unique_ptr<RagdollAsset> asset = test::bipedRagdoll();
    std::vector<physics::BodyState> states;
    std::vector<RigidTransform> bodies;
    std::vector<RigidTransform> joints;

    PosedDoll() {
        joints = asset->character.skeleton.bindModelFromJoint;
        states.resize(asset->profile.bodies.size());
        physics::bodiesFromPose(asset->rig, joints, {}, states);
        for (const physics::BodyState& state : states)
            bodies.push_back(state.worldFromBody);
    }
    [[nodiscard]] render::FrameDescription draw(const DebugLayers& layers) const {
        render::FrameDescription frame;
        DebugScratch scratch;
        drawDollDebug({*asset, bodies, states, joints, {}, false}, layers, scratch, frame);
        return frame;
    }
    physics::ConstraintProfile& first(physics::ConstraintProfile::Kind kind) {
        const auto found = std::find_if(asset->profile.constraints.begin(), asset->profile.constraints.end(),
                                        [&](const auto& constraint) { return constraint.kind == kind; });
        REQUIRE(found != asset->profile.constraints.end());
        return *found;
    }
};

bool draws(const render::FrameDescription& frame, render::Color color) {
    return std::any_of(frame.lines.vertices.begin(), frame.lines.vertices.end(),
                       [&](const render::LineVertex& vertex) { return sameColor(vertex.color, color); });
}

}  // namespace

TEST_CASE("every layer draws something by itself, in the colours of its legend") {
    const auto asset = test::bipedRagdoll();
    auto scenario = makeScenario({.name = "drop"}, *asset);
    REQUIRE(scenario);
    SimulationOptions options;
    options.world.solver = physics::SolverKind::bullet;  // one layer is its own
    const auto simulation = Simulation::create(*asset, std::move(scenario).value(), options);
    REQUIRE(simulation);
    for (int i = 0; i < 60; ++i)
        simulation.value()->step();
    for (const DebugLayerInfo& info : debugLayerInfos()) {
        INFO(info.name);
        CHECK_FALSE(info.title.empty());
        CHECK_FALSE(info.what.empty());
        CHECK_FALSE(info.legend.empty());
        DebugLayers layers;
        layers.*info.member = true;
        SimulationDrawer drawer;
        render::FrameDescription frame;
        drawer.draw(*simulation.value(), render::CharacterHandle{0}, layers, 1.0F, 1.0F, frame);
        const bool tinted = frame.characters[0].highlight.a > 0;
        CHECK((!frame.lines.empty() || !frame.solids.empty() || tinted));
        CHECK(tinted == layers.sleep);
        if (layers.bullet) continue;  // its colours are Bullet's
        const auto told = [&](render::Color color) {
            return std::any_of(info.legend.begin(), info.legend.end(),
                               [&](const render::LegendEntry& entry) { return sameColor(entry.color, color); });
        };
        for (const render::LineVertex& vertex : frame.lines.vertices)
            REQUIRE(told(vertex.color));
        for (const render::SolidVertex& vertex : frame.solids.vertices)
            REQUIRE(told(vertex.color));
    }
}

TEST_CASE("the legend of several layers has each meaning once") {
    DebugLayers layers;
    CHECK(legendOf(layers).empty());
    layers.capsules = layers.solidCapsules = layers.sleep = true;
    CHECK(legendOf(layers).size() == 2);
    layers.limits = true;
    CHECK(legendOf(layers).size() == 6);
}

TEST_CASE("Bullet's own drawer shows the dolls of its worlds, and the crowd solver's world has none") {
    const auto asset = test::bipedRagdoll();
    for (const auto solver : {physics::SolverKind::stock, physics::SolverKind::bullet, physics::SolverKind::crowd}) {
        INFO(physics::solverName(solver));
        auto scenario = makeScenario({.name = "drop"}, *asset);
        REQUIRE(scenario);
        SimulationOptions options;
        options.world.solver = solver;
        const auto simulation = Simulation::create(*asset, std::move(scenario).value(), options);
        REQUIRE(simulation);
        physics::World& world = simulation.value()->world();
        const auto bodies = simulation.value()->worldFromBody(0, 1.0F);
        world.addDrag({world.dolls()[0], 0, vec3(0), bodies[0].translation + vec3(0, 0.5F, 0), 100.0F});
        simulation.value()->step();
        std::vector<std::size_t> near(bodies.size());
        std::size_t lines = 0;
        world.drawDebug([&](const vec3& from, const vec3& to, const vec3& color) {
            ++lines;
            REQUIRE((isFinite(from) && isFinite(to) && isFinite(color)));
            for (std::size_t i = 0; i < bodies.size(); ++i)
                near[i] += glm::distance(from, bodies[i].translation) < 0.4F ? 1 : 0;
        });
        if (solver == physics::SolverKind::crowd) {
            CHECK(lines == 0);
            continue;
        }
        CHECK(lines > 20 * bodies.size());
        for (const std::size_t count : near)
            CHECK(count > 20);
    }
}

TEST_CASE("the margin of a limit is the angle that is left, and below zero the angle past it") {
    physics::ConstraintProfile hinge;
    hinge.kind = physics::ConstraintProfile::Kind::hinge;
    hinge.hinge.lower = radians(-20);
    hinge.hinge.upper = radians(100);
    physics::ConstraintState state;
    state.hingeAngle = radians(97);
    CHECK(degrees(limitMargin(hinge, state)) == Approx(3).margin(1e-3));
    state.hingeAngle = radians(-28);
    CHECK(degrees(limitMargin(hinge, state)) == Approx(-8).margin(1e-3));

    physics::ConstraintProfile cone;
    cone.kind = physics::ConstraintProfile::Kind::coneTwist;
    cone.cone.swingY = radians(30);
    cone.cone.swingZ = radians(60);
    cone.cone.twist = radians(40);
    state = {};
    CHECK(degrees(limitMargin(cone, state)) == Approx(30).margin(1e-3));
    state.swing = vec3(0, 0, radians(56));
    CHECK(degrees(limitMargin(cone, state)) == Approx(4).margin(1e-3));
    state.swing = vec3(0, radians(-35), 0);
    CHECK(degrees(limitMargin(cone, state)) == Approx(-5).margin(1e-3));
    // On the rim in between.
    state.swing = vec3(0, radians(30) * std::cos(0.7F), radians(60) * std::sin(0.7F));
    CHECK(limitMargin(cone, state) == Approx(0).margin(1e-5));
    state.swing = vec3(0);
    state.twist = radians(-38);
    CHECK(degrees(limitMargin(cone, state)) == Approx(2).margin(1e-3));
}

TEST_CASE("a limit is coloured within five degrees of it and past it, and so is the present angle") {
    PosedDoll doll;
    DebugLayers layers;
    layers.limits = true;
    // Every limit far away; then one at a distance from the present angle.
    for (physics::ConstraintProfile& constraint : doll.asset->profile.constraints) {
        constraint.hinge = {-3.0F, 3.0F};
        constraint.cone = {3.0F, 3.0F, 3.0F};
    }
    physics::ConstraintProfile& hinge = doll.first(physics::ConstraintProfile::Kind::hinge);
    const float now = physics::measureConstraint(hinge, doll.bodies[hinge.parent], doll.bodies[hinge.child]).hingeAngle;
    render::FrameDescription frame = doll.draw(layers);
    CHECK(draws(frame, debugColors::limit));
    CHECK(draws(frame, debugColors::presentAngle));
    CHECK_FALSE(draws(frame, debugColors::nearLimit));
    CHECK_FALSE(draws(frame, debugColors::pastLimit));
    hinge.hinge.upper = now + radians(4);
    frame = doll.draw(layers);
    CHECK(draws(frame, debugColors::nearLimit));
    CHECK_FALSE(draws(frame, debugColors::pastLimit));
    hinge.hinge.upper = now + radians(6);
    CHECK_FALSE(draws(doll.draw(layers), debugColors::nearLimit));
    // Passed is what is a degree past it: less is how softly a solver holds, and rounding.
    hinge.hinge.upper = now - radians(0.9F);
    frame = doll.draw(layers);
    CHECK(draws(frame, debugColors::nearLimit));
    CHECK_FALSE(draws(frame, debugColors::pastLimit));
    hinge.hinge.upper = now - radians(1.1F);
    CHECK(draws(doll.draw(layers), debugColors::pastLimit));
}

TEST_CASE("every debug layer of a doll is drawn at the moment that its skin shows") {
    const auto asset = test::bipedRagdoll();
    auto scenario = makeScenario({.name = "drop", .count = 1}, *asset);
    REQUIRE(scenario);
    const auto created = Simulation::create(*asset, std::move(scenario).value(), {});
    REQUIRE(created);
    Simulation& simulation = *created.value();
    for (int step = 0; step < 20; ++step)
        simulation.step();
    SimulationDrawer drawer;
    // Contacts and Bullet's own drawing are the world's: they are of its last step, whatever the picture shows.
    for (const DebugLayerInfo& layer : debugLayerInfos()) {
        const std::string name(layer.name);
        if (name == "contacts" || name == "bullet" || name == "sleep") continue;
        INFO(name);
        DebugLayers layers;
        layers.*layer.member = true;
        // How far what is drawn falls with the skin from one moment to the next: as far as the hips do.
        const auto lowest = [&](float alpha) {
            render::FrameDescription frame;
            drawer.draw(simulation, render::CharacterHandle{0}, layers, alpha, 1.0F, frame);
            float y = 100.0F;
            for (const auto& vertex : frame.lines.vertices)
                y = std::min(y, vertex.position.y);
            for (const auto& vertex : frame.solids.vertices)
                y = std::min(y, vertex.position.y);
            REQUIRE(y < 100.0F);
            return y;
        };
        const auto hips = [&](float alpha) { return simulation.worldFromBody(0, alpha)[0].translation.y; };
        const float fall = hips(0.0F) - hips(1.0F);
        REQUIRE(fall > 0.01F);
        for (const float alpha : {0.25F, 0.5F, 0.75F}) {
            CHECK(lowest(0.0F) - lowest(alpha) == Approx(hips(0.0F) - hips(alpha)).margin(0.2F * fall));
        }
    }
}
