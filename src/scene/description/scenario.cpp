#include "scene/description/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "scene/description/entity_colors.hpp"
#include "scene/description/free_places.hpp"

namespace lutka::scene {
namespace {

constexpr float kSpacing = 2.5F;      // metres between the dolls of a grid: nobody reaches a neighbour
constexpr float kPitHalf = 3.0F;      // the pit of `pile` is 6 × 6 m inside
constexpr float kPitSpacing = 1.15F;  // shoulder to shoulder
constexpr float kLayerHeight = 2.1F;  // above one another in the pit

constexpr vec3 kUp{0, 1, 0};
const quat kUpright(1, 0, 0, 0);

struct Context {
    int count;
    Random random;
    bool isSeedZero;
    FigureBounds figure;
    EntityScene& scene;

    // The start that is laid down by hand: nearly upright, nothing random. Further dolls beside it would fall in step.
    [[nodiscard]] bool isByHand(int doll) const { return isSeedZero && doll == 0; }
};

Collider& addStatic(Context& context, const char* name, const RigidTransform& world, const Collider& collider) {
    const EntityId id = addEntity(context.scene, name, world).id;
    MeshRenderer look;
    look.color = collider.kind == Collider::Kind::plane ? kFloorColor : kStandingColor;
    context.scene.add(id, look);
    return context.scene.add(id, collider);
}

void addFloor(Context& context) {
    Collider floor;
    floor.kind = Collider::Kind::plane;
    addStatic(context, "Floor", {}, floor);
}

Collider& addBox(Context& context, const char* name, const vec3& centre, const vec3& halfExtents) {
    Collider box;
    box.halfExtents = halfExtents;
    return addStatic(context, name, {kUpright, centre}, box);
}

float halfHeight(const Context& context) {
    return (context.figure.high.y - context.figure.low.y) * 0.5F;
}

// A character whose centre is at `centre`, turned by `turn` about that centre.
Ragdoll& placeCentre(Context& context, const vec3& centre, const quat& turn) {
    const int number = static_cast<int>(context.scene.all<Ragdoll>().size()) + 1;
    const std::string name = context.count > 1 ? fmt::format("Character {}", number) : "Character";
    const quat rotation = glm::normalize(turn);
    const vec3 feet = centre - rotation * (kUp * halfHeight(context));
    const EntityId id = addEntity(context.scene, name, {rotation, feet}).id;
    context.scene.add(id, MeshRenderer{.color = render::colors::white});
    return context.scene.add(id, Ragdoll{});
}

// A character whose soles, before it is turned, are at `foot`.
Ragdoll& placeFeet(Context& context, const vec3& foot, const quat& turn) {
    return placeCentre(context, foot + kUp * halfHeight(context), turn);
}

constexpr float kLargestTilt = radians(10.0F);

// Nothing starts exactly symmetric: what stands in exact balance, or folds onto both knees alike, stays there for good.
// Seed 0 leans this far to the front and the left.
const quat kSeedZeroLean = glm::angleAxis(radians(4.0F), glm::normalize(vec3(1, 0, -0.6F)));

// By hand: kSeedZeroLean. Else any heading, up to kLargestTilt.
quat smallTurn(Context& context, int doll) {
    if (context.isByHand(doll)) return kSeedZeroLean;
    const quat yaw = glm::angleAxis(context.random.uniform(-kPi, kPi), vec3(0, 1, 0));
    const float heading = context.random.uniform(-kPi, kPi);
    const float tilt = context.random.uniform(0.0F, kLargestTilt);
    return glm::angleAxis(tilt, vec3(std::cos(heading), 0, std::sin(heading))) * yaw;
}

// How deep the soles come when the figure is tilted about its centre: whoever stands with legs wide apart would start
// with one of them in the floor.
float dip(const Context& context, float tilt) {
    return context.figure.stance * std::sin(tilt) - halfHeight(context) * (1.0F - std::cos(tilt));
}

quat anyTurn(Context& context) {
    // Shoemake 1992, "Uniform random rotations".
    const float u = context.random.uniform(0, 1);
    const float a = context.random.uniform(0, 2 * kPi);
    const float b = context.random.uniform(0, 2 * kPi);
    return {std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
            std::sqrt(u) * std::sin(b)};
}

vec3 nudge(Context& context, int doll, float speed) {
    if (context.isByHand(doll)) return vec3(0);
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

void focusOnGrid(Context& context, float spacing) {
    context.scene.simulation.focusRadius = std::max(1.6F, static_cast<float>(gridSide(context.count)) * spacing * 0.6F);
}

// From where the action of a scene is seen best: pictures of each were looked at.
void look(Context& context, float yawDeg, float pitchDeg) {
    context.scene.simulation.focusYaw = radians(yawDeg);
    context.scene.simulation.focusPitch = radians(pitchDeg);
    context.scene.simulation.focusFollows = true;
}

void drop(Context& context) {
    look(context, 30, 12);
    addFloor(context);
    for (int i = 0; i < context.count; ++i) {
        const vec3 foot = gridPlace(i, context.count, kSpacing) + vec3(0, 1, 0);
        Ragdoll& doll = placeFeet(context, foot, smallTurn(context, i));
        doll.angularVelocity = nudge(context, i, 1.0F);
    }
    context.scene.simulation.focus = {0, 1.3F, 0};  // from the floor to the crown at the start
    focusOnGrid(context, kSpacing);
}

void spread(Context& context) {
    look(context, 30, 14);
    addFloor(context);
    for (int i = 0; i < context.count; ++i) {
        const vec3 centre = gridPlace(i, context.count, kSpacing) + vec3(0, 1.8F, 0);
        placeCentre(context, centre, anyTurn(context));
    }
    focusOnGrid(context, kSpacing);
}

// The pit's walls would hide what falls into it.
void addPitWall(Context& context, const vec3& centre, const vec3& halfExtents) {
    const EntityId id = addBox(context, "Wall", centre, halfExtents).entity;
    MeshRenderer& look = *context.scene.find<MeshRenderer>(id);
    look.opacity = 40.0F / 255.0F;
    look.castsShadow = false;
}

// Any turn in which the figure is clear of those that are placed; where there is none, the one of several that comes
// nearest to it.
quat freeTurn(Context& context, FreePlaces& placed, const vec3& centre) {
    constexpr int kTries = 40;
    quat best = anyTurn(context);
    float least = placed.depthAt(centre, best);
    for (int i = 1; i < kTries && least > 0.0F; ++i) {
        const quat turn = anyTurn(context);
        const float depth = placed.depthAt(centre, turn);
        if (depth >= least) continue;
        best = turn;
        least = depth;
    }
    placed.take(centre, best);
    return best;
}

void pile(Context& context) {
    look(context, 30, 24);
    constexpr float wall = 0.5F;
    constexpr float height = 4.0F;
    addFloor(context);
    for (const float side : {-1.0F, 1.0F}) {
        addPitWall(context, {side * (kPitHalf + wall), height, 0}, {wall, height, kPitHalf + 2 * wall});
        addPitWall(context, {0, height, side * (kPitHalf + wall)}, {kPitHalf + 2 * wall, height, wall});
    }
    constexpr int side = 4;
    constexpr int layer = side * side;
    FreePlaces placed(context.figure);
    for (int i = 0; i < context.count; ++i) {
        vec3 centre = gridPlace(i % layer, layer, kPitSpacing);
        // Drawn in statements of their own: compilers differ in the order of a call's arguments.
        const float ahead = context.random.uniform(-0.1F, 0.1F);
        const float aside = context.random.uniform(-0.1F, 0.1F);
        centre += vec3(aside, 0, ahead);
        const int storey = i / layer;
        centre.y = 1.3F + kLayerHeight * static_cast<float>(storey);
        placeCentre(context, centre, freeTurn(context, placed, centre));
    }
    context.scene.simulation.focusRadius = 5.0F;
    context.scene.simulation.seconds = 8.0F + 0.02F * static_cast<float>(context.count);
}

void stairs(Context& context) {
    look(context, 62, 12);
    Collider flight;
    flight.kind = Collider::Kind::stairs;
    flight.steps = 12;
    flight.rise = 0.17F;  // ordinary domestic stairs
    flight.run = 0.28F;
    flight.length = 2.0F;
    flight.width = 2.0F * (1.2F + kSpacing * static_cast<float>(context.count - 1) * 0.5F);
    const float top = flight.rise * static_cast<float>(flight.steps);
    const float front = flight.run * static_cast<float>(flight.steps);
    addFloor(context);
    addStatic(context, "Stairs", {kUpright, {0, 0, front}}, flight);
    constexpr float pitch = radians(12);  // already falling forward
    const float clearance = std::max(0.08F, dip(context, pitch));
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * 1.6F;
        const float heading = context.isByHand(i) ? 0.1F : context.random.uniform(-0.5F, 0.5F);
        const quat lean = glm::angleAxis(pitch, vec3(1, 0, 0)) * glm::angleAxis(heading, vec3(0, 1, 0));
        Ragdoll& doll = placeFeet(context, {across, top + clearance, -0.1F}, lean);
        doll.linearVelocity = vec3(0, 0, 1.6F) + nudge(context, i, 0.3F);
    }
    context.scene.simulation.focus = {0, 1.2F, front * 0.5F};
    context.scene.simulation.focusRadius = 2.9F;
    context.scene.simulation.seconds = 8.0F;
}

void ramp(Context& context) {
    look(context, 58, 12);
    Collider slope;
    slope.kind = Collider::Kind::ramp;
    slope.angle = 0.55F;  // radians: steep enough to slide at friction 0.5
    slope.length = 8.0F;
    slope.width = 2.0F * (1.5F + kSpacing * 0.5F * static_cast<float>(context.count));
    slope.friction = 0.5F;
    const float half = slope.length * 0.5F;
    addFloor(context);
    addStatic(context, "Ramp", {kUpright, {0, 0, half * std::cos(slope.angle)}}, slope);
    const quat tilt = glm::angleAxis(slope.angle, vec3(1, 0, 0));
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * 1.6F;
        const vec3 surface = tilt * vec3(0, 0, -half * 0.6F) + vec3(0, half * std::sin(slope.angle), 0);
        placeFeet(context, surface + vec3(across, 0.2F, 0), smallTurn(context, i));
    }
    context.scene.simulation.focus = {0, 1.4F, 0.6F};
    context.scene.simulation.focusRadius = 3.6F;
    context.scene.simulation.seconds = 8.0F;
}

// How high the soles start so that nothing meets the floor once all of it hangs straight below the left hand.
float hangingHeight(const FigureBounds& figure, const quat& turn) {
    const vec3 toHand = turn * (figure.hand - 0.5F * (figure.low + figure.high));
    return std::max(1.2F, figure.handReach + 0.1F - 0.5F * (figure.high.y - figure.low.y) - toHand.y);
}

void hang(Context& context) {
    look(context, 30, 8);
    addFloor(context);
    float highest = 0.0F;
    for (int i = 0; i < context.count; ++i) {
        const quat turn = smallTurn(context, i);
        const float height = hangingHeight(context.figure, turn);
        highest = std::max(highest, height);
        placeFeet(context, gridPlace(i, context.count, kSpacing) + vec3(0, height, 0), turn)
            .pins.push_back(context.figure.handBody.empty() ? "leftHand" : context.figure.handBody);
    }
    SceneSimulation& simulation = context.scene.simulation;
    simulation.focus = {0, 0.5F + highest, 0};
    focusOnGrid(context, kSpacing);
    simulation.focusRadius = std::max(simulation.focusRadius, 1.9F);
    simulation.seconds = 10.0F;
}

void throwAtWall(Context& context) {
    look(context, 105, 12);
    const float width = 2.0F + kSpacing * 0.5F * static_cast<float>(context.count);
    addFloor(context);
    addBox(context, "Wall", {0, 1.5F, 2.0F}, {width, 1.5F, 0.025F});
    // However it is turned, a figure larger than a person starts clear of floor and wall, too.
    const float reach = 0.5F * glm::distance(context.figure.low, context.figure.high) + 0.05F;
    const float height = std::max(1.6F, reach);
    const float ahead = std::min(-0.6F, 1.95F - reach);
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * kSpacing;
        const quat turn =
            context.isByHand(i) ? kSeedZeroLean * glm::angleAxis(radians(70), vec3(1, 0, 0)) : anyTurn(context);
        placeCentre(context, {across, height, ahead}, turn).linearVelocity = {0, 0, 8};
    }
    context.scene.simulation.focus = {0, 1.0F, 0.9F};
    context.scene.simulation.focusRadius = 2.4F;
}

struct Ball {
    float radius = 0.12F;
    float massKg = 4.0F;
};

void addBall(Context& context, const vec3& centre, const vec3& velocity, const Ball& kind = {}) {
    const EntityId id = addEntity(context.scene, "Ball", {kUpright, centre}).id;
    Collider ball;
    ball.kind = Collider::Kind::sphere;
    ball.radius = kind.radius;
    context.scene.add(id, ball);
    context.scene.add(id, RigidBody{.massKg = kind.massKg, .linearVelocity = velocity});
    context.scene.add(id, MeshRenderer{.color = kMovingColor});
}

void balls(Context& context) {
    look(context, 30, 14);
    addFloor(context);
    const float clearance = std::max(0.05F, dip(context, kLargestTilt));
    for (int i = 0; i < context.count; ++i) {
        const vec3 foot = gridPlace(i, context.count, kSpacing) + vec3(0, clearance, 0);
        placeFeet(context, foot, smallTurn(context, i));
        for (int ball = 0; ball < 6; ++ball) {
            const float heading = context.random.uniform(-kPi, kPi);
            const vec3 out(std::cos(heading), 0, std::sin(heading));
            const float distance = 2.0F + 1.2F * static_cast<float>(ball);
            addBall(context, foot + out * distance + vec3(0, 1.2F, 0), out * -6.0F + vec3(0, 1.5F, 0));
        }
    }
    focusOnGrid(context, kSpacing);
    context.scene.simulation.focusRadius = std::max(context.scene.simulation.focusRadius, 2.2F);
}

// Characters that follow a clip and get up when they were knocked down.
ScenePuppets& actors(Context& context, const char* clip) {
    ScenePuppets& puppets = context.scene.simulation.puppets.emplace();
    puppets.clip = clip;
    puppets.getUp = true;
    return puppets;
}

// Where one stands, a hair above the floor; shifted a little where it is not laid down by hand.
vec3 standAt(Context& context, int doll, const vec3& place) {
    return place + vec3(0, 0.002F, 0) + nudge(context, doll, 0.1F);
}

constexpr float kWalkSpeed = 0.95F;  // m/s, of the mannequin's clip
constexpr float kAdultM = 1.78F;     // the mannequin's height

// A ball that meets a point at a moment.
void throwBall(Context& context, const vec3& target, const vec3& from, float seconds, const Ball& kind = {}) {
    const vec3 gravity(0, -9.81F, 0);
    addBall(context, from, (target - from) / seconds - 0.5F * gravity * seconds, kind);
}

void walk(Context& context) {
    look(context, 58, 10);
    addFloor(context);
    actors(context, "walk").pace = kWalkSpeed;
    constexpr float start = -2.0F;
    for (int i = 0; i < context.count; ++i) {
        const float across = (static_cast<float>(i) - static_cast<float>(context.count - 1) * 0.5F) * kSpacing;
        const vec3 foot = standAt(context, i, {across, 0, start});
        placeFeet(context, foot, kUpright);
        // One at the shoulder, one from ahead, and three at once that are too much. Short flights: those of a second or
        // more come down so steeply that what a solver adds to their way makes them miss.
        const float size = (context.figure.high.y - context.figure.low.y) / kAdultM;
        const auto at = [&](float seconds, float height) {
            return foot + vec3(0, height * size, kWalkSpeed * seconds);
        };
        const float side = context.isByHand(i) || context.random.uniform(-1, 1) > 0 ? 1.0F : -1.0F;
        throwBall(context, at(0.6F, 1.35F), at(0.6F, 1.3F) + vec3(3.0F * side, 0, 0.4F), 0.6F);
        throwBall(context, at(1.1F, 1.25F), at(1.1F, 1.2F) + vec3(0.6F * side, 0, 6.0F), 1.1F);
        constexpr Ball kHeavy{.radius = 0.14F, .massKg = 6.0F};
        throwBall(context, at(1.7F, 1.45F), at(1.7F, 1.2F) + vec3(-25.0F * side, 0, 2.0F), 1.7F, kHeavy);
        throwBall(context, at(1.72F, 1.15F), at(1.72F, 1.2F) + vec3(-26.0F * side, 0, 1.0F), 1.72F, kHeavy);
        throwBall(context, at(1.76F, 1.30F), at(1.76F, 1.2F) + vec3(-27.0F * side, 0, 1.6F), 1.76F, kHeavy);
    }
    context.scene.simulation.focus = {0, 0.9F, 0.0F};
    focusOnGrid(context, kSpacing);
    context.scene.simulation.seconds = 10.0F;
}

void push(Context& context) {
    look(context, 25, 12);
    addFloor(context);
    actors(context, "idle");
    constexpr int directions = 8;
    for (int i = 0; i < context.count; ++i) {
        Ragdoll& doll = placeFeet(context, standAt(context, i, gridPlace(i, context.count, kSpacing)), kUpright);
        const float first = context.isByHand(i) ? 0.0F : context.random.uniform(0, 2 * kPi);
        for (int k = 0; k < directions; ++k) {
            const float angle = first + 2 * kPi * static_cast<float>(k) / static_cast<float>(directions);
            doll.hits.push_back({physics::Role::upperChest, 0.6F + 1.1F * static_cast<float>(k),
                                 70.0F * vec3(std::sin(angle), 0, std::cos(angle))});
        }
        doll.hits.push_back({physics::Role::upperChest, 9.8F, {20, 0, -160}});
        doll.hits.push_back({physics::Role::hips, 9.8F, {40, 30, -260}});
    }
    focusOnGrid(context, kSpacing);
    context.scene.simulation.seconds = 16.0F;
}

void getUp(Context& context) {
    look(context, 30, 16);
    addFloor(context);
    actors(context, "idle").limp = true;
    for (int i = 0; i < context.count; ++i)
        placeCentre(context, gridPlace(i, context.count, kSpacing) + vec3(0, 1.5F, 0), anyTurn(context));
    focusOnGrid(context, kSpacing);
    context.scene.simulation.seconds = 9.0F;
}

void march(Context& context) {
    look(context, 40, 18);
    addFloor(context);
    actors(context, "walk").pace = kWalkSpeed;
    for (int i = 0; i < context.count; ++i) {
        Ragdoll& doll =
            placeFeet(context, standAt(context, i, gridPlace(i, context.count, 1.8F) + vec3(0, 0, -3.0F)), kUpright);
        const float angle = context.random.uniform(0, 2 * kPi);
        const bool hard = context.random.uniform(0, 1) < 0.35F;
        const float seconds = context.random.uniform(0.5F, 4.0F);
        const vec3 way(std::sin(angle), 0.1F, std::cos(angle));
        doll.hits.push_back({physics::Role::upperChest, seconds, (hard ? 150.0F : 35.0F) * way});
        if (hard) doll.hits.push_back({physics::Role::hips, seconds, 250.0F * way});
    }
    focusOnGrid(context, 1.8F);
    context.scene.simulation.seconds = 10.0F;
}

struct Entry {
    ScenarioInfo info;
    void (*build)(Context&);
};

constexpr std::array<Entry, 12> kEntries{{
    {{"drop", "from 1 m, upright, onto a floor"}, &drop},
    {{"spread", "on a grid over a floor, in any orientation"}, &spread},
    {{"pile", "into a pit of 6 by 6 metres"}, &pile},
    {{"stairs", "pushed down a flight of 12 stairs"}, &stairs},
    {{"ramp", "down a slope of 32 degrees"}, &ramp},
    {{"hang", "by the left hand, clear of the floor"}, &hang},
    {{"throw", "into a wall of 5 cm at 8 m/s"}, &throwAtWall},
    {{"balls", "hit by six balls of 4 kg"}, &balls},
    {{"walk", "walking, hit by balls, and on again"}, &walk},
    {{"push", "standing, pushed from eight directions and over"}, &push},
    {{"getup", "falling limp and getting up"}, &getUp},
    {{"march", "walking side by side, hit at random"}, &march},
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

Result<EntityScene> makeScene(std::string_view name, int count, std::uint64_t seed, const FigureBounds& figure) {
    const auto* entry =
        std::find_if(kEntries.begin(), kEntries.end(), [&](const Entry& e) { return e.info.name == name; });
    if (entry == kEntries.end()) {
        return Error{ErrorCode::usage, fmt::format("there is no scene named '{}'", name), "--scene",
                     fmt::format("the scenes are {}; a file is named *.scene.json", knownNames())};
    }
    if (count < 1 || count > 10000) {
        return Error{ErrorCode::usage, fmt::format("{} dolls were asked for", count), "--count",
                     "1 to 10000 can be had"};
    }
    EntityScene scene;
    scene.name = name;
    scene.simulation.seed = seed;
    Context context{count, Random(seed), seed == 0, figure, scene};
    entry->build(context);
    return scene;
}

Result<Scenario> makeScenario(const NamedScene& scene, const Figure& figure) {
    const auto made = makeScene(scene.name, scene.count, scene.seed, figure.bounds);
    if (!made) return made.error();
    const std::vector<int> assetOfRagdoll(made.value().all<Ragdoll>().size(), 0);
    return compileScene(made.value(), std::span(&figure, 1), assetOfRagdoll);
}

Result<Scenario> makeScenario(const NamedScene& scene, const RagdollAsset& asset) {
    return makeScenario(scene, figureOf(asset));
}

}  // namespace lutka::scene
