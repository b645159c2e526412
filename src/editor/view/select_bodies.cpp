#include "editor/view/select_bodies.hpp"

namespace lutka::editor {

void selectMirror(Selection& selection, const physics::RagdollProfile& profile) {
    const std::vector<Item> items(selection.items().begin(), selection.items().end());
    selection.clear();
    for (Item item : items) {
        if (item.kind == Item::Kind::body) {
            const int other = physics::counterpartOf(profile, item.index);
            if (other >= 0) item.index = other;
        }
        if (!selection.contains(item)) selection.toggle(item);
    }
}

void selectChildren(Selection& selection, const physics::RagdollProfile& profile) {
    const std::vector<Item> items(selection.items().begin(), selection.items().end());
    for (const Item& item : items) {
        if (item.kind != Item::Kind::body) continue;
        // Parents come before their children.
        for (const physics::ConstraintProfile& constraint : profile.constraints) {
            const Item child{Item::Kind::body, item.doll, constraint.child};
            const bool hangs = selection.contains({Item::Kind::body, item.doll, constraint.parent});
            if (hangs && !selection.contains(child)) selection.toggle(child);
        }
    }
    // What was added last is the active one.
    if (!items.empty() && selection.active() != items.back()) selection.toggle(items.back());
}

std::vector<std::string> namesOf(const physics::RagdollProfile& profile, std::span<const int> bodies) {
    std::vector<std::string> names;
    for (const int body : bodies)
        names.push_back(profile.bodies[body].name);
    return names;
}

std::vector<int> bodiesNamed(const physics::RagdollProfile& profile, std::span<const std::string> names) {
    std::vector<int> bodies;
    for (const std::string& name : names) {
        const int body = physics::bodyNamed(profile, name);
        if (body >= 0) bodies.push_back(body);
    }
    return bodies;
}

}  // namespace lutka::editor
