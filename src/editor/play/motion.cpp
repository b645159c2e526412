#include "editor/play/motion.hpp"

namespace lutka::editor {

// Its start, to which it would be led at once, may be metres away, and the pull would knock it out.
void resumePuppet(scene::PuppetCast& puppets, int doll, const Motion::Doll& before, bool begun) {
    if (before.puppet) return puppets.resume(doll, *before.puppet);
    if (!begun || !puppets.settings().getUp) return;
    scene::PuppetMemory fallen = puppets.memoryOf(doll);
    fallen.limp = true;
    puppets.resume(doll, fallen);
}

}  // namespace lutka::editor
