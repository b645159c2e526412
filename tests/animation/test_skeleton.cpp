#include "animation/skeleton.hpp"

#include "animation/joint_paths.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

TEST_CASE("joints that share a name are told apart by their path") {
    const Skeleton skeleton = test::makeSkeleton({{"root", -1, {}}, {"arm", 0, {}}, {"arm", 0, {}}, {"tip", 2, {}}});
    CHECK(jointPath(skeleton, 1) == "root/arm");
    CHECK(jointPath(skeleton, 2) == "root/arm#2");
    CHECK(jointPath(skeleton, 3) == "root/arm#2/tip");
    CHECK(findJoint(skeleton, "arm") == kNoJoint);
    CHECK(findJoint(skeleton, "tip") == 3);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        CHECK(findJoint(skeleton, jointPath(skeleton, joint)) == joint);
    }
    CHECK(findJoint(skeleton, "root/leg") == kNoJoint);
    const std::vector<std::string> paths = jointPaths(skeleton);
    REQUIRE(paths.size() == 4);
    for (int joint = 0; joint < skeleton.jointCount(); ++joint)
        CHECK(paths[joint] == jointPath(skeleton, joint));
}

TEST_CASE("ancestry counts the joint itself and stops at other branches") {
    const Skeleton skeleton = test::makeSkeleton({{"a", -1, {}}, {"b", 0, {}}, {"c", 0, {}}, {"d", 1, {}}});
    CHECK(isAncestorOrSelf(skeleton, 0, 3));
    CHECK(isAncestorOrSelf(skeleton, 3, 3));
    CHECK_FALSE(isAncestorOrSelf(skeleton, 2, 3));
    CHECK_FALSE(isAncestorOrSelf(skeleton, 3, 0));
    CHECK(childrenOf(skeleton)[0] == std::vector<int>{1, 2});
}

TEST_CASE("a valid skeleton has no problems and every fault is named") {
    const Skeleton good = test::makeBiped().skeleton;
    CHECK(validate(good).empty());

    Skeleton wrongOrder = good;
    wrongOrder.parents[1] = 5;
    CHECK(validate(wrongOrder).size() == 1);

    Skeleton notFinite = good;
    notFinite.bindModelFromJoint[2].translation.x = NAN;
    notFinite.nodeParentFromJoint[3].rotation = quat(2, 0, 0, 0);
    notFinite.skinWeight[4] = -1;
    CHECK(validate(notFinite).size() == 3);

    Skeleton wrongSize = good;
    wrongSize.names.pop_back();
    CHECK(validate(wrongSize).size() == 1);
}
