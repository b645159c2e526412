#include "animation/humanoid/limb_reach.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;

TEST_CASE("a side of a limb that has no skin says nothing of where the limb ends") {
    // A leg from 0.9 m down whose one side alone moves skin, to the floor.
    RigFeatures rig;
    FramedRig framed;
    framed.rig = &rig;
    framed.subtreeSkin.resize(2);
    framed.subtreeJoints.resize(2);
    JointPair thighs;
    thighs.joints = {0, 1};
    thighs.position = {0.1F, 0.9F, 0};
    framed.pairs.push_back(thighs);
    for (const int side : {0, 1}) {
        framed.subtreeSkin.assign(2, Box{});
        framed.subtreeSkin[static_cast<std::size_t>(side)].add(vec3(side == 0 ? 0.1F : -0.1F, 0.9F, 0));
        framed.subtreeSkin[static_cast<std::size_t>(side)].add(vec3(side == 0 ? 0.1F : -0.1F, 0.0F, 0));
        const vec3 end = endOfSkin(framed, LimbKind::leg, 0, 0);
        CHECK(end.x == Approx(0.1F));
        CHECK(end.y == Approx(0.0F).margin(1e-6));
    }
    // Without any, the limb has no length.
    framed.subtreeSkin.assign(2, Box{});
    CHECK(endOfSkin(framed, LimbKind::leg, 0, 0).y == Approx(0.9F));
}
