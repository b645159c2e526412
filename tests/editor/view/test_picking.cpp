#include <glm/geometric.hpp>

#include "editor/sessions.hpp"
#include "editor/view/axis_lock.hpp"
#include "editor/view/picking.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

PickTarget boxAt(int entity, const vec3& at) {
    return {entity, {{1, 0, 0, 0}, at}, vec3(0.25F), false};
}

}  // namespace

TEST_CASE("the slab test meets the faces of a box where they are") {
    const RigidTransform frame{glm::angleAxis(kPi / 2, vec3(0, 0, 1)), {0, 0, -5}};
    const vec3 half(1.0F, 2.0F, 0.5F);  // turned: 2 wide, 1 high
    const render::Ray ahead{{0, 0, 0}, {0, 0, -1}};
    REQUIRE(rayBox(ahead, frame, half).has_value());
    CHECK(*rayBox(ahead, frame, half) == Approx(4.5F));
    CHECK(rayBox({{1.9F, 0, 0}, {0, 0, -1}}, frame, half).has_value());
    CHECK_FALSE(rayBox({{2.1F, 0, 0}, {0, 0, -1}}, frame, half).has_value());
    CHECK_FALSE(rayBox({{0, 1.1F, 0}, {0, 0, -1}}, frame, half).has_value());
    CHECK_FALSE(rayBox({{0, 0, 0}, {0, 0, 1}}, frame, half).has_value());
    CHECK(rayBox({{0, 0, -5}, {0, 0, 1}}, frame, half) == 0.0F);
    const auto parallel = rayBox({{0, 5, -5}, {0, -1, 0}}, frame, half);
    REQUIRE(parallel.has_value());
    CHECK(*parallel == Approx(4.0F));
}

TEST_CASE("the nearest of bodies and objects is picked, and markers before both") {
    const auto editor = test::makeEditor();
    const vec3 hips = test::placeOf(*editor, animation::Role::hips);
    const render::Ray ray{hips + vec3(0, 0, 3), {0, 0, -1}};
    const scene::Simulation& simulation = editor->player().simulation();
    const auto body = pick(ray, simulation, {});
    REQUIRE(body.has_value());
    CHECK(body->item.kind == Item::Kind::body);
    CHECK(editor->document().profile().bodies[body->item.index].role == animation::Role::hips);
    CHECK(body->position.z > hips.z);

    const PickTarget before = boxAt(8, hips + vec3(0, 0, 1));
    const PickTarget behind = boxAt(7, hips - vec3(0, 0, 1));
    const std::vector<PickTarget> boxes = {behind, before};
    const auto box = pick(ray, simulation, boxes);
    REQUIRE(box.has_value());
    CHECK(box->item == Item{Item::Kind::object, 0, 8});
    CHECK(glm::distance(box->normal, vec3(0, 0, 1)) < 1e-4F);

    PickTarget light = boxAt(9, hips - vec3(0, 0, 2));
    light.marker = true;
    const std::vector<PickTarget> withLight = {behind, light, before};
    const auto marker = pick(ray, simulation, withLight);
    REQUIRE(marker.has_value());
    CHECK(marker->item == Item{Item::Kind::object, 0, 9});

    CHECK_FALSE(pick({hips + vec3(0, 0, 3), {0, 1, 0}}, simulation, {}).has_value());
    CHECK_FALSE(pick({{5, 3, 0}, {0, -1, 0}}, simulation, {}).has_value());  // the floor is not picked
}

TEST_CASE("walls hide what is behind them unless they are see-through") {
    const auto editor = test::makeEditor();
    const vec3 at = test::placeOf(*editor, animation::Role::hips) + vec3(0, 0, 1);
    REQUIRE(editor->editScene("Wall", "", [&](scene::EntityScene& scene) {
        const scene::EntityId id = scene::addEntity(scene, scene::EntityKind::box, {{1, 0, 0, 0}, at}).id;
        scene.find<scene::Collider>(id)->halfExtents = vec3(1.0F, 1.0F, 0.1F);
    }));
    const vec3 hips = test::placeOf(*editor, animation::Role::hips);
    const render::Ray ray{hips + vec3(0, 0, 4), {0, 0, -1}};
    const scene::Simulation& simulation = editor->player().simulation();
    CHECK_FALSE(pick(ray, simulation, {}).has_value());
    const auto behind = pick(ray, simulation, {}, true);
    REQUIRE(behind.has_value());
    CHECK(behind->item.kind == Item::Kind::body);
    CHECK(behind->position.z == Approx(hips.z).margin(0.25));
}

TEST_CASE("a free drag keeps the depth, an axis lock the other two coordinates, a plane lock the third") {
    const vec3 start(0.3F, 1.0F, -0.2F);
    const vec3 eye(0, 1, 4);
    const vec3 forward(0, 0, -1);
    const render::Ray ray{eye, glm::normalize(vec3(0.2F, 0.1F, -1.0F))};
    const auto free = dragTarget(ray, start, forward, {});
    REQUIRE(free.has_value());
    CHECK(free->z == Approx(start.z));
    const auto deeper = dragTarget(ray, start, forward, {}, 0.5F);
    REQUIRE(deeper.has_value());
    CHECK(deeper->z == Approx(start.z - 0.5F));
    for (int axis = 0; axis < 2; ++axis) {
        const auto along = dragTarget(ray, start, forward, {AxisLock::Kind::axis, axis});
        REQUIRE(along.has_value());
        for (int other = 0; other < 3; ++other) {
            if (other != axis) CHECK((*along)[other] == Approx(start[other]));
        }
        CHECK((*along)[axis] != start[axis]);
    }
    const render::Ray down{eye, glm::normalize(vec3(0.1F, -0.3F, -1.0F))};
    const vec3 low(0, 0.2F, 0);
    const auto across = dragTarget(down, low, forward, {AxisLock::Kind::plane, 1});
    REQUIRE(across.has_value());
    CHECK(across->y == Approx(low.y));
}

TEST_CASE("a ray along the axis or the plane moves nothing") {
    const render::Ray ray{{0, 1, 4}, {0, 0, -1}};
    CHECK_FALSE(dragTarget(ray, vec3(0, 1, 0), {0, 0, -1}, {AxisLock::Kind::axis, 2}).has_value());
    CHECK_FALSE(dragTarget(ray, vec3(0, 0, 0), {0, 0, -1}, {AxisLock::Kind::plane, 1}).has_value());
}

TEST_CASE("an axis key locks, the same again takes the own axis and then frees, another changes") {
    AxisLock lock = pressAxis({}, 0, false);
    CHECK(lock == AxisLock{AxisLock::Kind::axis, 0});
    CHECK(pressAxis(lock, 0, false) == AxisLock{AxisLock::Kind::axis, 0, true});
    CHECK(pressAxis(pressAxis(lock, 0, false), 0, false) == AxisLock{});
    CHECK(pressAxis(lock, 1, true) == AxisLock{AxisLock::Kind::plane, 1});
    CHECK(lockText(pressAxis({}, 1, true)) == "in the XZ plane");
}

TEST_CASE("a number is typed as in Blender") {
    NumberEntry entry;
    CHECK_FALSE(entry.value().has_value());
    entry.type(NumberEntry::kPoint);
    CHECK_FALSE(entry.value().has_value());
    entry.type(5);
    CHECK(entry.value() == 0.5F);
    entry.type(NumberEntry::kMinus);
    CHECK(entry.value() == -0.5F);
    entry.type(NumberEntry::kPoint);  // a second point is nothing
    entry.type(2);
    CHECK(entry.text() == "-.52");
    entry.type(NumberEntry::kMinus);
    entry.backspace();
    CHECK(entry.value() == 0.5F);
}
