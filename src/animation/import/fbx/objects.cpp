#include "animation/import/fbx/objects.hpp"

#include <algorithm>
#include <set>
#include <tuple>

namespace lutka::animation::rig_import::fbx {
namespace {

constexpr std::string_view kBinarySeparator("\0\1", 2);

const Record* propertiesOf(const Record* owner) {
    if (owner == nullptr) return nullptr;
    const Record* list = owner->child("Properties70");
    return list != nullptr ? list : owner->child("Properties60");
}

// Class name → the record that holds the class's default properties.
std::map<std::string_view, const Record*> templatesOf(const Document& document) {
    std::map<std::string_view, const Record*> templates;
    const Record* definitions = document.root.child("Definitions");
    if (definitions == nullptr) return templates;
    for (const Record& type : definitions->children) {
        const Record* found = type.name == "ObjectType" ? type.child("PropertyTemplate") : nullptr;
        if (found != nullptr) templates[type.text(0)] = found;
    }
    return templates;
}

}  // namespace

Properties::Properties(const Record* owner, const Record* defaults)
    : own_(propertiesOf(owner)), defaults_(propertiesOf(defaults)) {}

const Record* Properties::findIn(const Record* list, std::string_view name) {
    if (list == nullptr) return nullptr;
    // Of two the last one counts.
    const auto found = std::find_if(list->children.rbegin(), list->children.rend(),
                                    [name](const Record& property) { return property.text(0) == name; });
    return found != list->children.rend() ? &*found : nullptr;
}

const Record* Properties::find(std::string_view name) const {
    const Record* own = findIn(own_, name);
    return own != nullptr ? own : findIn(defaults_, name);
}

bool Properties::states(std::string_view name) const {
    return findIn(own_, name) != nullptr;
}

double Properties::number(std::string_view name, double otherwise) const {
    const Record* property = find(name);
    return property != nullptr ? property->number(valuePlace(*property), otherwise) : otherwise;
}

std::int64_t Properties::integer(std::string_view name, std::int64_t otherwise) const {
    const Record* property = find(name);
    return property != nullptr ? property->integer(valuePlace(*property), otherwise) : otherwise;
}

glm::dvec3 Properties::vector(std::string_view name, const glm::dvec3& otherwise) const {
    const Record* property = find(name);
    if (property == nullptr) return otherwise;
    const std::size_t place = valuePlace(*property);
    return {property->number(place, otherwise.x), property->number(place + 1, otherwise.y),
            property->number(place + 2, otherwise.z)};
}

std::string_view Properties::text(std::string_view name) const {
    const Record* property = find(name);
    return property != nullptr ? property->text(valuePlace(*property)) : std::string_view{};
}

std::string plainName(std::string_view full) {
    if (const std::size_t end = full.find(kBinarySeparator); end != std::string_view::npos)
        return std::string(full.substr(0, end));
    if (const std::size_t start = full.find("::"); start != std::string_view::npos)
        return std::string(full.substr(start + 2));
    return std::string(full);
}

Objects::Objects(const Document& document) : children_(1) {
    const auto templates = templatesOf(document);
    for (const Record& section : document.root.children) {
        if (section.name == "Objects") addObjects(section, templates);
    }
    const Record* settings = document.root.child("GlobalSettings");
    for (const Object& object : objects_) {
        if (settings == nullptr && object.kind == "GlobalSettings") settings = object.record;
    }
    const auto defaults = templates.find("GlobalSettings");
    settings_ = Properties(settings, defaults != templates.end() ? defaults->second : nullptr);
    children_.resize(objects_.size() + 1);
    parents_.resize(objects_.size());
    for (const Record& section : document.root.children) {
        if (section.name == "Connections") connect(section);
    }
}

void Objects::addObjects(const Record& section, const std::map<std::string_view, const Record*>& templates) {
    for (const Record& record : section.children) {
        Object object;
        object.record = &record;
        object.kind = record.name;
        const auto defaults = templates.find(object.kind);
        object.properties = Properties(&record, defaults != templates.end() ? defaults->second : nullptr);
        // FBX 7: id, name, sub-kind. FBX 6: name, sub-kind, and the name is the id.
        const bool hasId = !record.values.empty() && record.text(0).data() == nullptr;
        const std::string_view full = record.text(hasId ? 1 : 0);
        object.name = plainName(full);
        object.subKind = record.text(hasId ? 2 : 1);
        const int index = static_cast<int>(objects_.size());
        if (hasId)
            byId_.emplace(record.integer(0), index);
        else
            byName_.emplace(full, index);
        objects_.push_back(std::move(object));
    }
}

int Objects::indexOf(const Record& record, std::size_t place) const {
    if (const std::string_view name = record.text(place); name.data() != nullptr) {
        const auto found = byName_.find(name);
        return found != byName_.end() ? found->second : -1;
    }
    const auto found = byId_.find(record.integer(place));
    return found != byId_.end() ? found->second : -1;
}

// The object at one end of a connection; kRoot for the scene, nothing for an object that isn't there.
std::optional<int> Objects::endOf(const Record& connection, std::size_t place) const {
    if (const int index = indexOf(connection, place); index >= 0) return index;
    const std::string_view name = connection.text(place);
    const bool isRoot = name.data() != nullptr ? plainName(name) == "Scene" || plainName(name) == "RootNode"
                                               : connection.integer(place, -1) == 0;
    return isRoot ? std::optional<int>(kRoot) : std::nullopt;
}

void Objects::connect(const Record& section) {
    std::set<std::tuple<int, int, std::string_view>> known;  // said twice, a curve would move its node twice as far
    for (const Record& record : section.children) {
        const std::string_view type = record.text(0);
        if (type != "OO" && type != "OP") continue;
        const std::optional<int> child = endOf(record, 1);
        const std::optional<int> parent = endOf(record, 2);
        if (!child || !parent || *child < 0 || *child == *parent) continue;
        const Connection connection{*child, *parent, type == "OP" ? record.text(3) : std::string_view{}};
        if (!known.emplace(connection.child, connection.parent, connection.property).second) continue;
        children_[static_cast<std::size_t>(*parent) + 1].push_back(connection);
        parents_[static_cast<std::size_t>(*child)].push_back(connection);
    }
}

std::span<const Connection> Objects::childrenOf(int index) const {
    return children_[static_cast<std::size_t>(index) + 1];
}

std::span<const Connection> Objects::parentsOf(int index) const {
    return parents_[static_cast<std::size_t>(index)];
}

std::vector<int> Objects::children(int index, std::string_view kind, std::string_view subKind) const {
    std::vector<int> found;
    for (const Connection& connection : childrenOf(index)) {
        const Object& child = (*this)[connection.child];
        if (child.kind == kind && (subKind.empty() || child.subKind == subKind)) found.push_back(connection.child);
    }
    return found;
}

int Objects::childAt(int index, std::string_view property, std::string_view kind) const {
    for (const Connection& connection : childrenOf(index)) {
        if (connection.property == property && (*this)[connection.child].kind == kind) return connection.child;
    }
    return -1;
}

}  // namespace lutka::animation::rig_import::fbx
