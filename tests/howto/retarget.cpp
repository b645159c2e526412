// Take a clip of one character to another, and play it there with a wave of the arms over the walk.
#include <cstdio>

#include "animation/export/write_glb.hpp"
#include "animation/import/import_character.hpp"
#include "animation/playback/clip_player.hpp"
#include "animation/retarget/retarget_clip.hpp"

using namespace lutka;

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const auto source = animation::importCharacter(argv[1]);
    const auto target = animation::importCharacter(argv[2]);
    if (!source || !target || source.value().clips.empty()) return 3;
    // [howto]
    const animation::Character& hero = target.value();
    const animation::HumanoidMap map = animation::mapHumanoid(hero);
    auto retargeter = animation::Retargeter::make(source.value(), animation::mapHumanoid(source.value()), hero, map);
    if (!retargeter) {
        std::fprintf(stderr, "%s\n", retargeter.error().text().c_str());
        return 3;
    }
    std::vector<animation::Clip> clips;
    for (const animation::Clip& clip : source.value().clips) {
        auto made = animation::retargetClip(retargeter.value(), clip);
        if (!made) return 3;
        std::printf("%s: limbs %.2f deg off, feet slide %.2f cm\n", clip.name.c_str(),
                    made.value().figures.meanLimbDeg(), made.value().figures.slideCm.most);
        clips.push_back(std::move(made).value().clip);
    }
    if (!animation::writeGlb(argv[3], hero, clips)) return 5;

    const auto library = animation::ClipLibrary::create(hero.skeleton, clips);
    if (!library) return 3;
    // Two layers: the last clip below, the first one on the upper body over it.
    animation::ClipPlayer player(library.value(), {{}, {.mask = upperBodyMask(hero.skeleton, map)}});
    player.play(0, library.value().clipCount() - 1);
    player.play(1, 0, {.speed = 0.5F, .fadeSeconds = 0.3F});
    std::vector<RigidTransform> parentFromJoint(hero.skeleton.parents.size());
    for (int frame = 0; frame < 120; ++frame) {
        player.advance(1.0F / 60.0F);  // allocates nothing, as pose() does
        player.pose(parentFromJoint);
    }
    // [/howto]
    return isFinite(parentFromJoint[0]) ? 0 : 1;
}
