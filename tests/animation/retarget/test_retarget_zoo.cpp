#include <fmt/format.h>

#include <algorithm>

#include "animation/import/import_character.hpp"
#include "animation/retarget/retarget_clip.hpp"
#include "support/catch.hpp"
#include "support/zoo.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

struct Figure {
    Character character;
    HumanoidMap map;
};

Figure loadFigureOf(const std::filesystem::path& file) {
    ImportOptions options;
    options.loadTextures = false;
    auto character = importCharacter(file, options);
    REQUIRE(character);
    HumanoidMap map = mapHumanoid(character.value());
    return {std::move(character).value(), std::move(map)};
}

RetargetFigures figuresOf(const Figure& source, const Clip& clip, const Figure& target) {
    auto retargeter = Retargeter::make(source.character, source.map, target.character, target.map);
    REQUIRE(retargeter);
    const auto made = retargetClip(retargeter.value(), clip);
    REQUIRE(made);
    return made.value().figures;
}

constexpr std::array kTargets{
    "makehuman_mixamo/makehuman_mixamo.glb", "rocketbox_male/Male_Adult_17.fbx",
    "mesh2motion_human/m2m_addon.glb",       "kaykit_rogue/Rogue_Hooded.glb",
    "sl_male_bento/male_bento.dae",          "makehuman_cmu_zup/makehuman_cmu_zup.glb",
    "lumberjack_rigify/lumberjack.glb",      "quaternius_platformer_ik/platformer_game_pack_Character.glb"};

}  // namespace

TEST_CASE("a motion capture plays on the zoo: limbs within three degrees, feet on the floor") {
    NEEDS_ZOO();
    const Figure source = loadFigureOf(test::zooFile("bvh_boxing/Boxing_Toes.bvh"));
    REQUIRE(source.character.clips.size() == 1);
    for (const char* file : kTargets) {
        const Figure target = loadFigureOf(test::zooFile(file));
        const RetargetFigures figures = figuresOf(source, source.character.clips[0], target);
        INFO(fmt::format("{}: {:.2f} deg, slide {:.2f} cm, floor {:.2f} cm", file, figures.meanLimbDeg(),
                         figures.slideCm.most, figures.penetrationCm.most));
        CHECK(figures.meanLimbDeg() < 3.0);
        CHECK(figures.slideCm.most < 0.1);
        CHECK(figures.penetrationCm.most < 0.5);
    }
}

TEST_CASE("clips of glTF and FBX files play on our mannequin") {
    NEEDS_ZOO();
    const Figure target = loadFigureOf(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    for (const char* file : {"cesium_man_glb/CesiumMan.glb", "quaternius_man_fbx/Male_Casual.fbx",
                             "kaykit_rogue/Rogue_Hooded.glb", "godot_mannequiny/mannequiny.glb"}) {
        const Figure source = loadFigureOf(test::zooFile(file));
        REQUIRE(!source.character.clips.empty());
        const RetargetFigures figures = figuresOf(source, source.character.clips[0], target);
        INFO(fmt::format("{}: {:.2f} deg, slide {:.2f} cm, floor {:.2f} cm", file, figures.meanLimbDeg(),
                         figures.slideCm.most, figures.penetrationCm.most));
        CHECK(figures.meanLimbDeg() < 3.0);
        CHECK(figures.penetrationCm.most < 0.5);
    }
}

TEST_CASE("a walk plays on figures without hands, feet, elbows or knees") {
    NEEDS_ZOO();
    const Figure source = loadFigureOf(std::filesystem::path(LUTKA_ASSETS_DIR) / "models/mannequin.glb");
    const auto walk = std::find_if(source.character.clips.begin(), source.character.clips.end(),
                                   [](const Clip& clip) { return clip.name == "walk"; });
    REQUIRE(walk != source.character.clips.end());
    for (const char* file : {"minetest_character/character.b3d", "hl1_man/man.mdl", "sketchbook_boxman/boxman.glb",
                             "quaternius_skeleton/q_skeleton.fbx", "godot_platformer_robot/platformer_player.glb"}) {
        const Figure target = loadFigureOf(test::zooFile(file));
        REQUIRE(!target.map.missing.empty());
        const RetargetFigures figures = figuresOf(source, *walk, target);
        INFO(fmt::format("{}: {:.2f} deg, floor {:.2f} cm", file, figures.meanLimbDeg(), figures.penetrationCm.most));
        CHECK(figures.meanLimbDeg() < 3.0);
        CHECK(figures.penetrationCm.most < 0.5);
    }
}
