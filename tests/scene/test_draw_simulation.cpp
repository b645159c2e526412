#include "scene/draw_simulation.hpp"

#include <glm/geometric.hpp>

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
    auto scenario =
        makeScenario("stairs", 2, 0, figureBounds(asset->profile, asset->rig), asset->profile.standardFromModel);
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
