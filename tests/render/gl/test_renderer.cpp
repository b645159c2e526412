#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "lone_figure.hpp"
#include "render/gl/pixels.hpp"
#include "support/command.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::render;

namespace {

constexpr Extent kRendererSize{320, 240};

/// The hand-made figure in front of the camera.
struct Scene : LoneFigure {
    explicit Scene(GlFixture& gl) : LoneFigure(gl) {
        frame.camera.yaw = 0.0F;
        frame.camera.pitch = radians(15);
        frameSphere(frame.camera, {0, 0.9F, 0}, 1.0F, kRendererSize.aspect());
    }
};

double differingShare(const Image& a, const Image& b) {
    return compareImages(a, b, 8).differingShare;
}

}  // namespace

TEST_CASE("fifty characters that share a mesh cost one draw call a mesh and pass") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    const CharacterItem first = scene.frame.characters[0];
    gl->renderer.draw(scene.frame, kRendererSize);
    const FrameStats one = gl->renderer.stats();
    CHECK(one.characterDrawCalls == 1);
    CHECK(one.shadowDrawCalls == 1);
    CHECK(one.instances == 1);

    for (int i = 1; i < 50; ++i) {
        CharacterItem item = first;
        item.worldFromModel.translation = vec3(static_cast<float>(i % 10) - 5.0F, 0, -static_cast<float>(i / 10));
        scene.frame.characters.push_back(item);
    }
    frameSphere(scene.frame.camera, {0, 0.9F, -2}, 8.0F, kRendererSize.aspect());
    gl->renderer.draw(scene.frame, kRendererSize);
    const FrameStats fifty = gl->renderer.stats();
    CHECK(fifty.instances == 50);
    CHECK(fifty.characterDrawCalls == 1);
    CHECK(fifty.shadowDrawCalls == 1);
    CHECK(fifty.drawCalls == one.drawCalls);
    CHECK(fifty.triangles > 49 * static_cast<long long>(scene.biped.meshes[0].indices.size() / 3));
}

TEST_CASE("each instance stands in its own pose at its own place") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    scene.frame.ambientOcclusion = false;
    // A second one to the right whose pose is moved up by a metre through its palette alone.
    std::vector<animation::SkinMatrix> raised = scene.palette;
    for (animation::SkinMatrix& matrix : raised)
        matrix.rows[1].w += 1.0F;
    CharacterItem item = scene.frame.characters[0];
    item.palette = raised;
    item.worldFromModel.translation = vec3(2, 0, 0);
    item.tint = vec3(1.0F, 0.05F, 0.05F);
    scene.frame.characters.push_back(item);
    frameSphere(scene.frame.camera, {1, 1.3F, 0}, 2.0F, kRendererSize.aspect());
    const Image image = gl->picture(scene.frame, kRendererSize);
    const Color plain = pixelAt(image, scene.frame.camera, {0, 1.10F, 0.13F});
    const Color tinted = pixelAt(image, scene.frame.camera, {2, 2.10F, 0.13F});
    CHECK(std::abs(plain.r - plain.g) < 30);
    CHECK(tinted.r > tinted.g + 80);
}

TEST_CASE("a character outside the picture is culled but still casts its shadow") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    scene.frame.characters[0].worldFromModel.translation = vec3(0, 0, 30);
    gl->renderer.draw(scene.frame, kRendererSize);
    CHECK(gl->renderer.stats().culledInstances == 1);
    CHECK(gl->renderer.stats().characterDrawCalls == 0);
    CHECK(gl->renderer.stats().shadowDrawCalls == 1);
}

TEST_CASE("the shadow darkens the floor below a body and nowhere else") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    scene.frame.floor.gridSpacing = 0.0F;
    scene.frame.ambientOcclusion = false;
    scene.frame.sun.directionToLight = vec3(0, 1, 0.2F);
    // Half a metre above the floor, so that the floor below it is in sight.
    scene.frame.characters[0].worldFromModel.translation = vec3(0, 0.5F, 0);
    const vec3 below(0, 0, -0.25F);
    const vec3 aside(0.9F, 0, 0.6F);
    const Image with = gl->picture(scene.frame, kRendererSize);
    scene.frame.sun.castsShadow = false;
    const Image without = gl->picture(scene.frame, kRendererSize);
    const Camera& camera = scene.frame.camera;
    CHECK(brightness(pixelAt(with, camera, below)) < 0.7 * brightness(pixelAt(without, camera, below)));
    CHECK(std::abs(brightness(pixelAt(with, camera, aside)) - brightness(pixelAt(without, camera, aside))) <= 6);
}

TEST_CASE("a lit surface does not shade itself") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    // A ball and a tilted box alone: everything that faces the light must look the same with and without the shadow.
    FrameDescription frame;
    frame.ambientOcclusion = false;
    frame.floor.visible = false;
    frame.sun.directionToLight = vec3(0.4F, 0.8F, 0.6F);
    PropItem ball;
    ball.kind = ShapeKind::sphere;
    ball.radius = 0.5F;
    ball.worldFromShape.translation = vec3(-0.7F, 0, 0);
    PropItem box;
    box.halfExtents = vec3(0.4F);
    box.worldFromShape = {glm::angleAxis(0.6F, vec3(0, 1, 0)), vec3(0.8F, 0, -0.6F)};
    frame.props = {ball, box};
    frameSphere(frame.camera, vec3(0), 1.4F, kRendererSize.aspect());
    const Image with = gl->picture(frame, kRendererSize);
    frame.sun.castsShadow = false;
    const Image without = gl->picture(frame, kRendererSize);
    // The ball throws no shadow on the box from there; at the terminator the light is nearly nothing anyway.
    CHECK(differingShare(with, without) < 0.01);
}

TEST_CASE("ambient occlusion darkens the corner between a box and the floor") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    FrameDescription frame;
    frame.sun.intensity = 0.0F;
    frame.floor.gridSpacing = 0.0F;
    PropItem box;
    box.halfExtents = vec3(0.5F);
    box.worldFromShape.translation = vec3(0, 0.5F, 0);
    frame.props = {box};
    frame.camera.yaw = 0.0F;
    frameSphere(frame.camera, {0, 0.4F, 0}, 1.2F, kRendererSize.aspect());
    const vec3 corner(0, 0, 0.53F);
    const vec3 open(0, 0, 1.2F);
    const Image with = gl->picture(frame, kRendererSize);
    frame.ambientOcclusion = false;
    const Image without = gl->picture(frame, kRendererSize);
    CHECK(brightness(pixelAt(with, frame.camera, corner)) < 0.85 * brightness(pixelAt(without, frame.camera, corner)));
    CHECK(std::abs(brightness(pixelAt(with, frame.camera, open)) - brightness(pixelAt(without, frame.camera, open))) <=
          6);
}

TEST_CASE("a point light lights what is near it, and a spot only what is in its cone") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    FrameDescription frame;
    frame.sun.intensity = 0.0F;
    frame.sky.intensity = 0.05F;
    frame.ambientOcclusion = false;
    frame.floor.gridSpacing = 0.0F;
    frame.camera.pitch = radians(50);
    frameSphere(frame.camera, vec3(0), 2.0F, kRendererSize.aspect());
    const vec3 below(0);
    const vec3 aside(1.2F, 0, 0);
    LocalLight light;
    light.position = vec3(0, 1, 0);
    light.range = 3.0F;
    light.intensity = 1.0F;
    const Image dark = gl->picture(frame, kRendererSize);
    frame.localLights = {light};
    const Image point = gl->picture(frame, kRendererSize);
    light.outerAngle = radians(30);
    light.innerAngle = radians(20);
    frame.localLights = {light};
    const Image spot = gl->picture(frame, kRendererSize);
    const auto at = [&](const Image& image, const vec3& place) {
        return brightness(pixelAt(image, frame.camera, place));
    };
    CHECK(at(point, below) > at(dark, below) + 150);
    CHECK(at(point, aside) > at(dark, aside) + 60);
    CHECK(at(point, below) > at(point, aside) + 60);
    CHECK(std::abs(at(spot, below) - at(point, below)) <= 6);
    CHECK(std::abs(at(spot, aside) - at(dark, aside)) <= 3);
}

TEST_CASE("from below the floor lets one see through") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    scene.frame.camera.pitch = radians(-40);
    scene.frame.characters[0].tint = vec3(1.0F, 0.02F, 0.02F);
    const Image image = gl->picture(scene.frame, kRendererSize);
    const Color body = pixelAt(image, scene.frame.camera, {0.1F, 0.5F, 0.05F});
    CHECK(body.r > body.g + 30);
}

TEST_CASE("debug lines and solids are drawn, hidden ones faintly, each in a fixed number of draw calls") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    const Image bare = gl->picture(scene.frame, kRendererSize);
    const int bareCalls = gl->renderer.stats().drawCalls;
    const RigidTransform chest{quat(1, 0, 0, 0), vec3(0, 1.3F, 0)};

    addCapsule(scene.frame.solids, chest, 0.25F, 0.1F, withAlpha(colors::cyan, 0.5F));
    const Image solid = gl->picture(scene.frame, kRendererSize);
    CHECK(differingShare(bare, solid) > 0.02);
    const Color onChest = pixelAt(solid, scene.frame.camera, {0, 1.3F, 0.25F});
    CHECK(onChest.b > onChest.r + 20);
    CHECK(gl->renderer.stats().drawCalls == bareCalls + 3);
    CHECK(gl->renderer.stats().debugDrawCalls == 3);

    scene.frame.solids.clear();
    for (int i = 0; i < 200; ++i)
        addCapsule(scene.frame.lines, chest, 0.25F, 0.1F, colors::orange);
    const Image wire = gl->picture(scene.frame, kRendererSize);
    CHECK(differingShare(bare, wire) > 0.005);
    CHECK(gl->renderer.stats().drawCalls == bareCalls + 1);
    CHECK(gl->renderer.stats().debugUploads == 1);

    // Inside the body: seen only when hidden lines are shown.
    scene.frame.lines.clear();
    scene.frame.lines.add({0, 1.22F, 0}, {0, 1.42F, 0}, colors::red);
    scene.frame.lineWidth = 4.0F;
    scene.frame.hiddenLineOpacity = 0.0F;
    CHECK(differingShare(bare, gl->picture(scene.frame, kRendererSize)) == 0.0);
    scene.frame.hiddenLineOpacity = 1.0F;
    CHECK(differingShare(bare, gl->picture(scene.frame, kRendererSize)) > 0.0005);
}

TEST_CASE("a translucent character lets the background through, and a highlight shows") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    const vec3 belly(0, 1.10F, 0.13F);
    scene.frame.characters[0].tint = vec3(0.02F);
    const Color solid = pixelAt(gl->picture(scene.frame, kRendererSize), scene.frame.camera, belly);
    scene.frame.characters[0].opacity = 0.3F;
    const Color clear = pixelAt(gl->picture(scene.frame, kRendererSize), scene.frame.camera, belly);
    CHECK(brightness(clear) > brightness(solid) + 150);
    scene.frame.characters[0].opacity = 1.0F;
    scene.frame.characters[0].highlight = withAlpha(colors::orange, 0.9F);
    scene.frame.characters[0].highlightJoint = 1;  // the spine, which owns the belly
    const Image lit = gl->picture(scene.frame, kRendererSize);
    const Color marked = pixelAt(lit, scene.frame.camera, belly);
    CHECK(marked.r > marked.b + 50);
    const Color head = pixelAt(lit, scene.frame.camera, {0, 1.66F, 0.09F});
    CHECK(std::abs(head.r - head.b) < 25);
}

TEST_CASE("a texture is sampled at its own place with its first row on top") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    animation::Character painted = makeBiped();
    animation::Texture texture;
    texture.width = 1;
    texture.height = 2;
    texture.rgba = {220, 20, 20, 255, 20, 20, 220, 255};  // red above blue
    painted.textures.push_back(texture);
    painted.materials[0].baseColor = vec4(1);
    painted.materials[0].baseColorTexture = 0;
    for (vec2& uv : painted.meshes[0].uvs)
        uv.y = 0.25F + 0.5F * std::round(uv.y);
    scene.frame.characters[0].character = gl->upload(painted);
    const Image image = gl->picture(scene.frame, kRendererSize);
    // The spine's tube runs from its joint (v = 0: the first row) upwards.
    const Color low = pixelAt(image, scene.frame.camera, {0, 1.07F, 0.13F});
    CHECK(low.r > low.b + 60);
}

TEST_CASE("a material that names a missing texture is drawn without it and told once") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    animation::Character biped = makeBiped();
    biped.materials[0].name = "cloth";
    biped.materials[0].normalTexture = 3;
    static_cast<void>(gl->upload(biped));
    REQUIRE(gl->renderer.warnings().size() == 1);
    CHECK(gl->renderer.warnings()[0].find("cloth") != std::string::npos);
}

TEST_CASE("a texture of 16384 pixels is drawn, and one larger than the driver takes is left out with its size") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    animation::Character biped = makeBiped();
    for (const int width : {std::min(most, 16384), most + 1}) {
        animation::Texture texture;
        texture.width = width;
        texture.height = 1;
        texture.rgba.assign(static_cast<std::size_t>(width) * 4, 200);
        biped.textures.push_back(std::move(texture));
    }
    biped.materials[0].baseColorTexture = 0;
    biped.materials[0].emissiveTexture = 1;
    static_cast<void>(gl->upload(biped));
    REQUIRE(gl->renderer.warnings().size() == 1);
    CHECK(gl->renderer.warnings()[0].find(std::to_string(most + 1) + " x 1") != std::string::npos);
}

TEST_CASE("a picture larger than driver or memory is refused before it is drawn, the smallest is drawn") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    CHECK(Renderer::checkSize({1, 1}).ok());
    CHECK(Renderer::checkSize({8192, 8192}).ok());
    CHECK_FALSE(Renderer::checkSize({1 << 20, 16}).ok());
    const auto large = Renderer::checkSize({16384, 16384});
    REQUIRE_FALSE(large.ok());
    CHECK(large.error().code == ErrorCode::usage);
    CHECK(gl->picture({}, {1, 1}).size() == Extent{1, 1});
}

TEST_CASE("meshes whose arrays do not fit together are refused") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    const auto refused = [&](const auto& spoil) {
        animation::Character biped = makeBiped();
        spoil(biped);
        const Result<CharacterHandle> handle = gl->renderer.uploadCharacter(biped);
        return !handle.ok() && handle.error().code == ErrorCode::input;
    };
    CHECK(refused([](animation::Character& c) { c.meshes[0].normals.pop_back(); }));
    CHECK(refused([](animation::Character& c) { c.meshes[0].weights.pop_back(); }));
    CHECK(refused([](animation::Character& c) { c.meshes[0].uvs.pop_back(); }));
    CHECK(refused([](animation::Character& c) { c.meshes[0].indices.pop_back(); }));
    CHECK(refused([](animation::Character& c) { c.meshes[0].indices[4] = 1U << 30U; }));
    CHECK(refused([](animation::Character& c) { c.meshes[0].joints[0][0] = 500; }));
    CHECK(refused([](animation::Character& c) { c.meshes[0].material = 7; }));
    CHECK_FALSE(refused([](animation::Character&) {}));
}

TEST_CASE("the same frame gives the same picture, also at another size in between") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    Scene scene(*gl);
    const Image first = gl->picture(scene.frame, kRendererSize);
    const Image small = gl->picture(scene.frame, {97, 61});
    CHECK(small.size() == Extent{97, 61});
    CHECK(gl->picture(scene.frame, kRendererSize).rgba == first.rgba);
}

TEST_CASE("a shader that does not compile is told with its file and line") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    namespace fs = std::filesystem;
    const test::ScratchFolder scratch;
    const fs::path& folder = scratch.path;
    fs::copy(fs::path(LUTKA_ASSETS_DIR) / "shaders", folder / "shaders");
    std::ofstream(folder / "shaders" / "noise.glsl") << "float pixelNoise() {\n    return nothing;\n}\n";
    ::setenv("LUTKA_ASSETS", folder.c_str(), 1);
    const Result<Renderer> broken = Renderer::create(gl->context);
    ::unsetenv("LUTKA_ASSETS");
    REQUIRE_FALSE(broken.ok());
    CHECK(broken.error().code == ErrorCode::internal);
    CHECK(broken.error().location == "noise.glsl:2");
    CHECK(broken.error().message.find("nothing") != std::string::npos);
}
