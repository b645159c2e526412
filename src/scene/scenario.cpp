#include "scene/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "scene/body_bounds.hpp"

namespace lutka::scene {
namespace {

using physics::BodyShape;
using physics::StaticShape;

constexpr float kSpacing = 2.5F;      // metres between the dolls of a grid: nobody reaches a neighbour
constexpr float kPitHalf = 3.0F;      // the pit of `pile` is 6 × 6 m inside
constexpr float kPitSpacing = 1.15F;  // shoulder to shoulder
constexpr float kLayerHeight = 2.1F;  // above one another in the pit

struct Context {
    int count;
    Random random;
    bool upright;  // seed 0
    FigureBounds figure;
    quat standardFromModel;
};

StaticShape plane() {
    return {};
}

StaticShape box(const vec3& centre, const vec3& halfExtents, const quat& rotation = quat(1, 0, 0, 0)) {
    StaticShape shape;
    shape.kind = StaticShape::Kind::box;
    shape.worldFromShape = {rotation, centre};
    shape.halfExtents = halfExtents;
    return shape;
}

vec3 centreOf(const FigureBounds& figure) {
    return (figure.low + figure.high) * 0.5F;
}

// Puts the figure's centre at `centre`, turned by `turn` about that centre.
Placement placeCentre(const Context& context, const vec3& centre, const quat& turn) {
    Placement placement;
    placement.worldFromModel.rotation = glm::normalize(turn * context.standardFromModel);
    placement.worldFromModel.translation = centre - turn * centreOf(context.figure);
    return placement;
}

// Puts the figure's soles, before it is turned, at `foot`.
Placement placeFeet(const Context& context, const vec3& foot, const quat& turn) {
    const float halfHeight = (context.figure.high.y - context.figure.low.y) * 0.5F;
    return placeCentre(context, foot + vec3(0, halfHeight, 0), turn);
}

// Seed 0: none. Others: any heading, up to 10 degrees of tilt.
quat smallTurn(Context& context) {
    if (context.upright) return {1, 0, 0, 0};
    const quat yaw = glm::angleAxis(context.random.uniform(-kPi, kPi), vec3(0, 1, 0));
    const float heading = context.random.uniform(-kPi, kPi);
    const float tilt = context.random.uniform(0.0F, radians(10.0F));
    return glm::angleAxis(tilt, vec3(std::cos(heading), 0, std::sin(heading))) * yaw;
}

quat anyTurn(Context& context) {
    // Shoemake 1992, "Uniform random rotations".
    const float u = context.random.uniform(0, 1);
    const float a = context.random.uniform(0, 2 * kPi);
    const float b = context.random.uniform(0, 2 * kPi);
    return {std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
            std::sqrt(u) * std::sin(b)};
}

vec3 nudge(Context& context, float speed) {
    if (context.upright) return vec3(0);
    return {context.random.uniform(-speed, speed), 0, context.random.uniform(-speed, speed)};
}

int gridSide(int count) {
    return static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
}

vec3 gridPlace(int index, int count, float spacing) {
    const int side = gridSide(count);
    const int row = index / side;
    const int column = index % side;
    const float middle = static_cast<float>(side - 1) * 0.5F;
    return {(static_cast<float>(column) - middle) * spacing, 0, (static_cast<float>(row) - middle) * spacing};
}

void focusOnGrid(Scenario& scenario, int count, float spacing) {
    scenario.focusRadius = std::max(1.6F, static_cast<float>(gridSide(count)) * spacing * 0.6F);
}

void drop(Context& context, Scenario& scenario) {
    scenario.statics.push_back(plane());
    for (int i = 0; i < context.count; ++i) {
        const vec3 foot = gridPlace(i, context.count, kSpacing) + vec3(0, 1, 0);
        Placement placement = placeFeet(context, foot, smallTurn(context));
        placement.angularVelocity = nudge(context, 1.0F);
        scenario.dolls.push_back(placement);
    }
    scenario.focus = {0, 1.3F, 0};  // from the floor to the crown at the start
    focusOnGrid(scenario, context.count, kSpacing);
}

void spread(Context& context, Scenario& scenario) {
    scenario.statics.push_back(plane());
    for (int i = 0; i < context.count; ++i) {
        const vec3 centre = gridPlace(i, context.count, kSpacing) + vec3(0, 1.8F, 0);
        scenario.dolls.push_back(placeCentre(context, centre, anyTurn(context)));
    }
    focusOnGrid(scenario, context.count, kSpacing);
}

void pile(Context& context, Scenario& scenario) {
    constexpr float wall = 0.5F;
    constexpr float height = 4.0F;
    scenario.statics.push_back(plane());
    for (const float side : {-1.0F, 1.0F}) {
        scenario.statics.push_back(box({side * (kPitHalf + wall), height, 0}, {wall, height, kPitHalf + 2 * wall}));
        scenario.statics.push_back(box({0, height, side * (kPitHalf + wall)}, {kPitHalf + 2 * wall, height, wall}));
    }
    constexpr int side = 4;
    constexpr int layer = side * side;
    for (int i = 0; i < context.count; ++i) {
        vec3 centre = gridPlace(i % layer, layer, kPitSpacing);
        centre += vec3(context.random.uniform(-0.1F, 0.1F), 0, context.random.uniform(-0.1F, 0.1F));
        const int storey = i / layer;
        centre.y = 1.3F + kLayerHeight * static_cast<float>(storey);
        scenario.dolls.push_back(placeCentre(context, centre, anyTurn(context)));
    }
    scenario.focusRadius = 5.0F;
    scenario.seconds = 8.0F + 0.02F * static_cast<float>(context.count);
}

void stairs(Context& context, Scenario& scenario) {
    constexpr int steps = 12;
    constexpr float rise = 0.17F;  // ordinary domestic stairs
    constexpr float run = 0.28F;
    const float width = 1.2F + kSpacing * static_cast<float>(context.count - 1) * 0.5F;
    constexpr float top = rise * steps;
    scenario.statics.push_back(plane());
    for (int i = 0; i < steps; ++i) {
        const float height = top - rise * static_cast<float>(i);
        // Each step reaches back under the ones above, so that no edge is exposed between two of them.
        const float back = -2.0F;
        const float front = run * static_cast<float>(i + 1);
        scenario.statics.push_back(
            box({0, height * 0.5F, (back + front) * 0.5F}, {width, height * 0.5F, (front - back) * 0.5F}));
    }
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * 1.6F;
        const float heading = context.upright ? 0.0F : context.random.uniform(-0.5F, 0.5F);
        const quat lean = glm::angleAxis(radians(12), vec3(1, 0, 0)) * glm::angleAxis(heading, vec3(0, 1, 0));
        Placement placement = placeFeet(context, {across, top + 0.08F, -0.1F}, lean);
        placement.linearVelocity = vec3(0, 0, 1.6F) + nudge(context, 0.3F);
        scenario.dolls.push_back(placement);
    }
    scenario.focus = {0, 1.2F, run * steps * 0.5F};
    scenario.focusRadius = 2.9F;
    scenario.seconds = 8.0F;
}

void ramp(Context& context, Scenario& scenario) {
    constexpr float angle = 0.55F;  // radians: steep enough to slide at friction 0.5
    constexpr float half = 4.0F;
    const float width = 1.5F + kSpacing * 0.5F * static_cast<float>(context.count);
    scenario.statics.push_back(plane());
    const quat tilt = glm::angleAxis(angle, vec3(1, 0, 0));
    StaticShape slope = box({0, 0, 0}, {width, 0.25F, half}, tilt);
    slope.worldFromShape.translation = tilt * vec3(0, -0.25F, 0) + vec3(0, half * std::sin(angle), 0);
    slope.friction = 0.5F;
    scenario.statics.push_back(slope);
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * 1.6F;
        const vec3 surface = tilt * vec3(0, 0, -half * 0.6F) + vec3(0, half * std::sin(angle), 0);
        scenario.dolls.push_back(placeFeet(context, surface + vec3(across, 0.2F, 0), smallTurn(context)));
    }
    scenario.focus = {0, 1.4F, 0.6F};
    scenario.focusRadius = 3.6F;
    scenario.seconds = 8.0F;
}

void hang(Context& context, Scenario& scenario) {
    scenario.statics.push_back(plane());
    for (int i = 0; i < context.count; ++i) {
        const vec3 foot = gridPlace(i, context.count, kSpacing) + vec3(0, 1.2F, 0);
        scenario.dolls.push_back(placeFeet(context, foot, smallTurn(context)));
        scenario.pins.push_back({i, physics::Role::leftHand});
    }
    scenario.focus = {0, 1.7F, 0};
    focusOnGrid(scenario, context.count, kSpacing);
    scenario.focusRadius = std::max(scenario.focusRadius, 1.9F);
    scenario.seconds = 10.0F;
}

void throwAtWall(Context& context, Scenario& scenario) {
    const float width = 2.0F + kSpacing * 0.5F * static_cast<float>(context.count);
    scenario.statics.push_back(plane());
    scenario.statics.push_back(box({0, 1.5F, 2.0F}, {width, 1.5F, 0.025F}));
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * kSpacing;
        const quat turn = context.upright ? glm::angleAxis(radians(70), vec3(1, 0, 0)) : anyTurn(context);
        Placement placement = placeCentre(context, {across, 1.6F, -0.6F}, turn);
        placement.linearVelocity = {0, 0, 8};
        scenario.dolls.push_back(placement);
    }
    scenario.focus = {0, 1.0F, 0.9F};
    scenario.focusRadius = 2.4F;
}

void balls(Context& context, Scenario& scenario) {
    scenario.statics.push_back(plane());
    for (int i = 0; i < context.count; ++i) {
        const vec3 foot = gridPlace(i, context.count, kSpacing) + vec3(0, 0.05F, 0);
        scenario.dolls.push_back(placeFeet(context, foot, smallTurn(context)));
        for (int ball = 0; ball < 6; ++ball) {
            const float heading = context.random.uniform(-kPi, kPi);
            const vec3 out(std::cos(heading), 0, std::sin(heading));
            const float distance = 2.0F + 1.2F * static_cast<float>(ball);
            physics::DynamicProp prop;
            prop.shape.kind = BodyShape::Kind::sphere;
            prop.shape.radius = 0.12F;
            prop.massKg = 4.0F;
            prop.state.worldFromBody.translation = foot + out * distance + vec3(0, 1.2F, 0);
            prop.state.linearVelocity = out * -6.0F + vec3(0, 1.5F, 0);
            scenario.props.push_back(prop);
        }
    }
    focusOnGrid(scenario, context.count, kSpacing);
    scenario.focusRadius = std::max(scenario.focusRadius, 2.2F);
}

struct Entry {
    ScenarioInfo info;
    void (*build)(Context&, Scenario&);
};

constexpr std::array<Entry, 8> kEntries{{
    {{"drop", "from 1 m, upright, onto a floor"}, &drop},
    {{"spread", "on a grid over a floor, in any orientation"}, &spread},
    {{"pile", "into a pit of 6 by 6 metres"}, &pile},
    {{"stairs", "pushed down a flight of 12 stairs"}, &stairs},
    {{"ramp", "down a slope of 32 degrees"}, &ramp},
    {{"hang", "by the left hand, 1.2 m above a floor"}, &hang},
    {{"throw", "into a wall of 5 cm at 8 m/s"}, &throwAtWall},
    {{"balls", "hit by six balls of 4 kg"}, &balls},
}};

constexpr auto kRegistry = [] {
    std::array<ScenarioInfo, kEntries.size()> infos{};
    for (std::size_t i = 0; i < kEntries.size(); ++i)
        infos[i] = kEntries[i].info;
    return infos;
}();

std::string knownNames() {
    std::string names;
    for (const Entry& entry : kEntries)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.info.name);
    return names;
}

}  // namespace

std::span<const ScenarioInfo> scenarioRegistry() {
    return kRegistry;
}

FigureBounds figureBounds(const physics::RagdollProfile& profile, const physics::Rig& rig) {
    FigureBounds bounds{vec3(1e9F), vec3(-1e9F)};
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        const RigidTransform standardFromBody =
            RigidTransform{profile.standardFromModel, vec3(0)} * rig.bindModelFromBody[body];
        const vec3 half = halfAabbOf(profile.bodies[body].shape, standardFromBody.rotation);
        bounds.low = glm::min(bounds.low, standardFromBody.translation - half);
        bounds.high = glm::max(bounds.high, standardFromBody.translation + half);
    }
    return bounds;
}

Result<Scenario> makeScenario(std::string_view name, int count, std::uint64_t seed, const FigureBounds& figure,
                              const quat& standardFromModel) {
    const auto* entry =
        std::find_if(kEntries.begin(), kEntries.end(), [&](const Entry& e) { return e.info.name == name; });
    if (entry == kEntries.end()) {
        return Error{ErrorCode::usage, fmt::format("there is no scene named '{}'", name), "--scene",
                     fmt::format("the scenes are {}", knownNames())};
    }
    if (count < 1 || count > 10000) {
        return Error{ErrorCode::usage, fmt::format("{} dolls were asked for", count), "--count",
                     "1 to 10000 can be had"};
    }
    Context context{count, Random(seed), seed == 0, figure, standardFromModel};
    Scenario scenario;
    scenario.name = name;
    scenario.seed = seed;
    entry->build(context, scenario);
    return scenario;
}

}  // namespace lutka::scene
