#include "scene/description/entity_scene.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::scene;

namespace {

RigidTransform at(float x, float y, float z, float turn = 0.0F) {
    return {glm::angleAxis(turn, vec3(0, 1, 0)), {x, y, z}};
}

bool mentions(const std::vector<std::string>& problems, const std::string& part) {
    return std::any_of(problems.begin(), problems.end(),
                       [&](const std::string& problem) { return problem.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("what hangs on an entity moves with it and stays where it is when it is hung elsewhere") {
    EntityScene scene;
    const EntityId base = addEntity(scene, "base", at(1, 0, 0, kPi / 2)).id;
    const EntityId arm = addEntity(scene, "arm", at(0, 0, 2), base).id;
    CHECK(glm::distance(worldFromEntity(scene, arm).translation, vec3(3, 0, 0)) < 1e-5F);
    CHECK(worldFromEntities(scene)[1].translation == worldFromEntity(scene, arm).translation);
    REQUIRE(reparentEntity(scene, arm, kNoEntity));
    CHECK(glm::distance(scene.find<Transform>(arm)->parentFromEntity.translation, vec3(3, 0, 0)) < 1e-5F);
    REQUIRE(reparentEntity(scene, arm, base));
    CHECK(glm::distance(scene.find<Transform>(arm)->parentFromEntity.translation, vec3(0, 0, 2)) < 1e-5F);
    CHECK_FALSE(reparentEntity(scene, base, arm));  // would close a ring
    CHECK_FALSE(reparentEntity(scene, base, base));
    CHECK(findEntity(scene, base)->parent == kNoEntity);
}

TEST_CASE("removing an entity takes its components and all that hangs on it") {
    EntityScene scene;
    const EntityId kept = addEntity(scene, EntityKind::box, {}).id;
    const EntityId gone = addEntity(scene, EntityKind::sphere, {}).id;
    const EntityId child = addEntity(scene, EntityKind::point, {}).id;
    REQUIRE(reparentEntity(scene, child, gone));
    removeEntity(scene, gone);
    REQUIRE(scene.entities.size() == 1);
    CHECK(scene.entities[0].id == kept);
    CHECK(scene.all<Light>().empty());
    CHECK(scene.all<RigidBody>().empty());
    CHECK(scene.all<Collider>().size() == 1);
    CHECK(validate(scene).empty());
}

TEST_CASE("a duplicate has all components under an id and a name of its own, its children too") {
    EntityScene scene;
    const EntityId lamp = addEntity(scene, EntityKind::capsule, at(1, 2, 3)).id;
    const EntityId bulb = addEntity(scene, EntityKind::spot, at(1, 3, 3)).id;
    REQUIRE(reparentEntity(scene, bulb, lamp));
    scene.find<Light>(bulb)->intensity = 7.0F;
    const EntityId copy = duplicateEntity(scene, lamp);
    REQUIRE(scene.entities.size() == 4);
    CHECK(findEntity(scene, copy)->name == "Capsule 2");
    CHECK(scene.entities[3].name == "Spot light 2");
    CHECK(scene.entities[3].parent == copy);
    CHECK(scene.find<Light>(scene.entities[3].id)->intensity == 7.0F);
    CHECK(scene.find<RigidBody>(copy) != nullptr);
    CHECK(worldFromEntity(scene, copy).translation == vec3(1, 2, 3));
    CHECK(duplicateEntity(scene, 999) == kNoEntity);
    CHECK(validate(scene).empty());
}

TEST_CASE("every kind that can be added is sound by itself") {
    EntityScene scene;
    for (int kind = 0; kind < kEntityKindCount; ++kind) {
        const Entity& entity = addEntity(scene, static_cast<EntityKind>(kind), at(static_cast<float>(kind), 1, 0));
        CHECK(entity.name == entityKindName(static_cast<EntityKind>(kind)));
    }
    const auto problems = validate(scene);
    CHECK(problems.empty());
    for (const std::string& problem : problems)
        FAIL_CHECK(problem);
}

TEST_CASE("stairs rise a step a run, and a ramp by its angle, from the frame's origin to the back") {
    Collider stairs;
    stairs.kind = Collider::Kind::stairs;
    stairs.steps = 5;
    stairs.rise = 0.2F;
    stairs.run = 0.3F;
    stairs.length = 1.0F;
    const auto steps = boxesOf(stairs);
    REQUIRE(steps.size() == 5);
    for (int i = 0; i < 5; ++i) {
        const ColliderBox& box = steps[i];
        const float level = static_cast<float>(i);
        CHECK(box.entityFromBox.translation.y + box.halfExtents.y == Approx(0.2F * (level + 1)));
        CHECK(box.entityFromBox.translation.z + box.halfExtents.z == Approx(-0.3F * level).margin(1e-6));
        CHECK(box.entityFromBox.translation.z - box.halfExtents.z == Approx(-2.5F));
        CHECK(box.entityFromBox.translation.y - box.halfExtents.y == Approx(0.0F).margin(1e-6));
    }
    Collider ramp;
    ramp.kind = Collider::Kind::ramp;
    ramp.angle = 0.5F;
    ramp.length = 4.0F;
    const auto slab = boxesOf(ramp);
    REQUIRE(slab.size() == 1);
    const vec3& half = slab[0].halfExtents;
    const vec3 low = slab[0].entityFromBox * vec3(0, half.y, half.z);
    const vec3 high = slab[0].entityFromBox * vec3(0, half.y, -half.z);
    CHECK(glm::length(low) < 1e-5F);
    CHECK(high.y == Approx(4.0F * std::sin(0.5F)));
    CHECK(high.z == Approx(-4.0F * std::cos(0.5F)));
}

TEST_CASE("a check lists every problem of a scene with its place") {
    EntityScene scene;
    const EntityId box = addEntity(scene, EntityKind::box, {}).id;
    const EntityId character = addEntity(scene, EntityKind::character, {}).id;
    const EntityId sun = addEntity(scene, EntityKind::sun, {}).id;
    const EntityId floor = addEntity(scene, EntityKind::floor, {}).id;
    scene.find<Collider>(box)->halfExtents.y = -1.0F;
    scene.find<Transform>(box)->parentFromEntity.rotation = quat(2, 0, 0, 0);
    scene.add(character, Collider{});
    scene.find<Light>(sun)->color.r = NAN;
    scene.add(floor, RigidBody{});
    addEntity(scene, EntityKind::sun, {});
    findEntity(scene, sun)->parent = 77;
    findEntity(scene, box)->name.clear();
    scene.entities[3].id = sun;  // twice
    scene.simulation.world.gravity.x = INFINITY;
    scene.simulation.world.substeps = 0;
    const auto problems = validate(scene);
    for (const char* place :
         {"/entities/0/collider/halfExtents/1", "/entities/0/transform/rotation", "/entities/1/collider",
          "/entities/2/light/color/0", "/entities/4/light/kind", "/entities/2/parent", "/entities/0/name",
          "/entities/3/id", "/simulation/gravity/0", "/simulation/substeps", "rigidBody"}) {
        INFO(place);
        CHECK(mentions(problems, place));
    }
}

TEST_CASE("a ring of parents and a chain without end are refused") {
    EntityScene scene;
    const EntityId a = addEntity(scene, "a").id;
    const EntityId b = addEntity(scene, "b", {}, a).id;
    findEntity(scene, a)->parent = b;
    CHECK(mentions(validate(scene), "does not hang on this entity itself"));
    EntityScene chain;
    EntityId last = kNoEntity;
    for (int i = 0; i < 70; ++i)
        last = addEntity(chain, "link", {}, last).id;
    CHECK(mentions(validate(chain), "at most 64"));
}
