// Pictures against baselines in tests/golden, made with Mesa's llvmpipe and looked at before they were committed.

#include <filesystem>

#include "animation/import/import_character.hpp"
#include "gl_fixture.hpp"
#include "golden.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::render;

namespace {

constexpr Extent kPictureSize{480, 360};
constexpr Extent kSmall{320, 240};

animation::Character mannequin() {
    Result<animation::Character> loaded =
        animation::importCharacter(std::filesystem::path(LUTKA_ASSETS_DIR) / "models" / "mannequin.glb");
    if (!loaded) FAIL(loaded.error().text());
    return std::move(loaded).value();
}

CharacterItem itemOf(CharacterHandle handle, const std::vector<animation::SkinMatrix>& palette) {
    CharacterItem item;
    item.character = handle;
    item.palette = palette;
    return item;
}

}  // namespace

TEST_CASE("picture: the mannequin on the floor with its shadow") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    const animation::Character figure = mannequin();
    const auto palette = bindPalette(figure.skeleton);
    FrameDescription frame;
    frame.characters.push_back(itemOf(gl->upload(figure), palette));
    frameSphere(frame.camera, {0, 0.85F, 0}, 0.95F, kPictureSize.aspect());
    checkGolden(gl->picture(frame, kPictureSize), "render_mannequin");
}

TEST_CASE("picture: props, debug capsules, axes and limits over a figure") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    const animation::Character biped = makeBiped();
    const auto palette = bindPalette(biped.skeleton);
    FrameDescription frame;
    frame.characters.push_back(itemOf(gl->upload(biped), palette));
    PropItem box;
    box.worldFromShape = {glm::angleAxis(0.5F, vec3(0, 1, 0)), {-0.8F, 0.2F, -0.4F}};
    box.halfExtents = vec3(0.2F);
    box.checkerSize = 0.1F;
    PropItem ball;
    ball.kind = ShapeKind::sphere;
    ball.radius = 0.18F;
    ball.worldFromShape.translation = {0.7F, 0.18F, 0.3F};
    ball.color = colors::red;
    ball.roughness = 0.3F;
    PropItem glass = ball;
    glass.kind = ShapeKind::capsule;
    glass.halfLength = 0.15F;
    glass.worldFromShape.translation = {0.75F, 0.33F, -0.5F};
    glass.color = withAlpha(colors::blue, 0.5F);
    frame.props = {box, ball, glass};
    const RigidTransform chest{quat(1, 0, 0, 0), {0, 1.32F, 0}};
    const RigidTransform thigh{quat(1, 0, 0, 0), {0.1F, 0.7F, 0}};
    addCapsule(frame.solids, chest, 0.18F, 0.08F, withAlpha(colors::cyan, 0.4F));
    addCapsule(frame.lines, chest, 0.18F, 0.08F, colors::cyan);
    addCapsule(frame.solids, thigh, 0.1F, 0.12F, withAlpha(colors::orange, 0.4F));
    addCapsule(frame.lines, thigh, 0.1F, 0.12F, colors::orange);
    const RigidTransform shoulder{quat(1, 0, 0, 0), {0.18F, 1.42F, 0}};
    addSwingCone(frame.lines, shoulder, 0.7F, 0.9F, 0.35F, colors::yellow);
    addAxes(frame.lines, {quat(1, 0, 0, 0), {-0.46F, 1.42F, 0}}, 0.15F);
    addArc(frame.lines, {quat(1, 0, 0, 0), {-0.1F, 0.5F, 0}}, radians(-90), radians(40), 0.2F, colors::green);
    addSector(frame.solids, {quat(1, 0, 0, 0), {-0.1F, 0.5F, 0}}, radians(-90), radians(40), 0.2F,
              withAlpha(colors::green, 0.3F));
    frameSphere(frame.camera, {0, 0.85F, 0}, 0.95F, kPictureSize.aspect());
    checkGolden(gl->picture(frame, kPictureSize), "render_debug_layers");
}

TEST_CASE("picture: a forearm twisted by 160 degrees is wrung by linear blending and whole with dual quaternions") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    const animation::Character figure = mannequin();
    std::vector<RigidTransform> pose = figure.skeleton.bindModelFromJoint;
    const int hand = animation::findJoint(figure.skeleton, "leftHand");
    const int elbow = animation::findJoint(figure.skeleton, "leftLowerArm");
    REQUIRE((hand >= 0 && elbow >= 0));
    const vec3 wrist = pose[hand].translation;
    const vec3 along = glm::normalize(wrist - pose[elbow].translation);
    // The hand and its fingers turn about the forearm.
    const quat twist = glm::angleAxis(radians(160), along);
    const RigidTransform turned{twist, wrist - twist * wrist};
    for (int joint = 0; joint < figure.skeleton.jointCount(); ++joint) {
        int at = joint;
        while (at >= 0 && at != hand)
            at = figure.skeleton.parents[at];
        if (at == hand) pose[joint] = turned * pose[joint];
    }
    const auto palette = paletteOf(figure.skeleton, pose);
    FrameDescription frame;
    CharacterItem linear = itemOf(gl->upload(figure), palette);
    CharacterItem dual = linear;
    linear.worldFromModel.translation.y = 0.13F;
    dual.worldFromModel.translation.y = -0.13F;
    dual.skinning = animation::SkinningMethod::dualQuaternion;
    frame.characters = {linear, dual};
    frame.floor.visible = false;
    frame.camera.yaw = 0.0F;
    frame.camera.pitch = 0.0F;
    frameSphere(frame.camera, wrist - 0.04F * along, 0.3F, kSmall.aspect());
    checkGolden(gl->picture(frame, kSmall), "render_forearm");
    CHECK(gl->renderer.stats().characterDrawCalls == static_cast<int>(figure.meshes.size()));
}
