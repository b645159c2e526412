#include "render/gl/draw_list.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::render {

void DrawList::Entries::clear() {
    shadow.clear();
    opaque.clear();
    translucent.clear();
}

void DrawList::begin(const FrameDescription& frame) {
    characterEntries_.clear();
    propEntries_.clear();
    firstPaletteJoint_.clear();
    palettes_.clear();
    instances_.clear();
    for (Pass* pass : {&shadow_, &opaque_, &translucent_}) {
        pass->characters.clear();
        pass->props.clear();
    }
    casters_ = {};
    forward_ = forwardOf(frame.camera);
    eye_ = eyeOf(frame.camera);
    culled_ = 0;
    dropped_ = 0;
}

void DrawList::addCharacter(const CharacterItem& item, const BoundingSphere& bounds, const mat4& clipFromWorld) {
    const Entry entry{item.character.index, static_cast<int>(firstPaletteJoint_.size()),
                      glm::dot(bounds.center - eye_, forward_), bounds.radius};
    firstPaletteJoint_.push_back(static_cast<int>(palettes_.size()));
    appendPalette(item, palettes_);
    const bool translucent = item.opacity < 1.0F;
    if (item.castsShadow && !bounds.empty()) {
        casters_ = enclosing(casters_, bounds);
        characterEntries_.shadow.push_back(entry);
    }
    if (!mayBeSeen(bounds, clipFromWorld)) {
        ++culled_;
        return;
    }
    (translucent ? characterEntries_.translucent : characterEntries_.opaque).push_back(entry);
}

// Props are few and simple: they are not culled.
void DrawList::addProp(const PropItem& item) {
    const BoundingSphere bounds = boundsOf(item);
    const auto index = static_cast<int>(propEntries_.opaque.size() + propEntries_.translucent.size());
    const Entry entry{static_cast<int>(item.kind), index, glm::dot(bounds.center - eye_, forward_), bounds.radius};
    if (item.castsShadow) {
        casters_ = enclosing(casters_, bounds);
        propEntries_.shadow.push_back(entry);
    }
    (item.color.a < 255 ? propEntries_.translucent : propEntries_.opaque).push_back(entry);
}

template <class Instance>
void DrawList::makeBatches(std::vector<Entry>& entries, bool sortByDepth, std::vector<Batch>& batches,
                           const Instance& instance) {
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
        if (a.what != b.what) return a.what < b.what;
        if (sortByDepth && a.depth != b.depth) return a.depth > b.depth;
        return a.item < b.item;
    });
    for (const Entry& entry : entries) {
        if (batches.empty() || batches.back().what != entry.what) {
            batches.push_back({entry.what, static_cast<int>(instances_.size()), 0, entry.depth - entry.radius});
        }
        ++batches.back().count;
        batches.back().nearest = std::min(batches.back().nearest, entry.depth - entry.radius);
        instances_.push_back(instance(entry.item));
    }
}

void DrawList::finish(const FrameDescription& frame) {
    const auto character = [&](int i) { return makeInstance(frame.characters[i], firstPaletteJoint_[i]); };
    const auto prop = [&](int i) { return makeInstance(frame.props[i]); };
    makeBatches(characterEntries_.shadow, false, shadow_.characters, character);
    makeBatches(characterEntries_.opaque, false, opaque_.characters, character);
    makeBatches(characterEntries_.translucent, true, translucent_.characters, character);
    makeBatches(propEntries_.shadow, false, shadow_.props, prop);
    makeBatches(propEntries_.opaque, false, opaque_.props, prop);
    makeBatches(propEntries_.translucent, true, translucent_.props, prop);
}

}  // namespace lutka::render
