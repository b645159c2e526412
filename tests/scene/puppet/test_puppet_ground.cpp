#include "scene/puppet/puppet_ground.hpp"

#include <glm/gtc/quaternion.hpp>

#include "scene/run/make_world.hpp"
#include "support/catch.hpp"

using namespace lutka;

namespace {

physics::StaticShape boxAt(const vec3& at, const vec3& half, const quat& turn = quat(1, 0, 0, 0)) {
    physics::StaticShape shape;
    shape.kind = physics::StaticShape::Kind::box;
    shape.halfExtents = half;
    shape.worldFromShape = {turn, at};
    return shape;
}

}  // namespace

TEST_CASE("the ground is what stays where it is: rays go through what lies on it") {
    const auto world = scene::makeWorld({});
    const physics::StaticShape floor;
    const physics::StaticShape block = boxAt({2, 0.25F, 0}, {0.5F, 0.25F, 0.5F});
    world->addStatic(floor);
    world->addStatic(block);
    physics::DynamicProp prop;
    prop.shape.kind = physics::BodyShape::Kind::box;
    prop.shape.halfExtents = vec3(0.2F);
    prop.state.worldFromBody.translation = vec3(0, 0.2F, 0);
    world->addProp(prop);
    const std::array<physics::StaticShape, 2> statics{floor, block};
    const scene::PuppetGround ground(statics);
    CHECK_FALSE(ground.isLevel());
    CHECK(scene::PuppetGround(std::span(statics).first(1)).isLevel());
    CHECK(ground.footing(*world, {0, 0.1F, 0})->height == Approx(0.0F).margin(1e-4));
    CHECK(ground.footing(*world, {2, 0.1F, 0})->height == Approx(0.5F).margin(1e-4));
    CHECK_FALSE(ground.footing(*world, {0, 5.0F, 0}));
    CHECK(ground.heightBelow(*world, {0, 5.0F, 0}) == Approx(0.0F).margin(1e-4));
    CHECK(ground.heightBelow(*world, {0, 50.0F, 0}) == Approx(40.0F));
}
