#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

#include "animation/import/fbx/document.hpp"

namespace lutka::animation::rig_import::fbx {

/// An object's properties by name, over the defaults of its class (the template in the document's Definitions).
class Properties {
  public:
    Properties() = default;
    /// Of a record that may hold Properties70 (FBX 7) or Properties60 (FBX 6); both may be null and must outlive this.
    Properties(const Record* owner, const Record* defaults);

    [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
    /// Whether the object itself states it, rather than its class.
    [[nodiscard]] bool states(std::string_view name) const;
    [[nodiscard]] double number(std::string_view name, double otherwise) const;
    [[nodiscard]] std::int64_t integer(std::string_view name, std::int64_t otherwise) const;
    [[nodiscard]] glm::dvec3 vector(std::string_view name, const glm::dvec3& otherwise) const;
    [[nodiscard]] std::string_view text(std::string_view name) const;

  private:
    // The property's record; its value begins at place 3 (FBX 6) or 4 (FBX 7).
    [[nodiscard]] const Record* find(std::string_view name) const;
    [[nodiscard]] static const Record* findIn(const Record* list, std::string_view name);
    [[nodiscard]] static std::size_t valuePlace(const Record& property) { return property.name == "P" ? 4 : 3; }

    const Record* own_ = nullptr;
    const Record* defaults_ = nullptr;
};

/// An object of the document.
struct Object {
    const Record* record = nullptr;
    std::string_view kind;     ///< "Model", "Geometry", "Deformer" …
    std::string_view subKind;  ///< "LimbNode", "Mesh", "Cluster" …
    std::string name;          ///< Without its class.
    Properties properties;
};

/// `child` belongs to `parent`, or to the parent's property of that name.
struct Connection {
    int child = -1;
    int parent = -1;
    std::string_view property;
};

/// All objects of a document and how they hang together. Points into the document.
class Objects {
  public:
    static constexpr int kRoot = -1;  ///< The scene's root, which is no object.

    explicit Objects(const Document& document);

    [[nodiscard]] std::span<const Object> all() const { return objects_; }
    [[nodiscard]] const Object& operator[](int index) const { return objects_[static_cast<std::size_t>(index)]; }
    /// What is connected to an object (or to kRoot), in file order.
    [[nodiscard]] std::span<const Connection> childrenOf(int index) const;
    /// What an object is connected to, in file order; `parent` may be kRoot.
    [[nodiscard]] std::span<const Connection> parentsOf(int index) const;
    /// The children of that kind and sub-kind (empty: any), in file order.
    [[nodiscard]] std::vector<int> children(int index, std::string_view kind, std::string_view subKind = {}) const;
    /// The object of that kind connected to the property of that name; -1 without.
    [[nodiscard]] int childAt(int index, std::string_view property, std::string_view kind) const;
    /// By the id (FBX 7) or the name with its class (FBX 6) in that place of a record; -1 for none.
    [[nodiscard]] int indexOf(const Record& record, std::size_t place) const;

    [[nodiscard]] const Properties& settings() const { return settings_; }

  private:
    void addObjects(const Record& section, const std::map<std::string_view, const Record*>& templates);
    void connect(const Record& section);
    [[nodiscard]] std::optional<int> endOf(const Record& connection, std::size_t place) const;

    std::vector<Object> objects_;
    std::unordered_map<std::int64_t, int> byId_;
    std::unordered_map<std::string_view, int> byName_;
    std::vector<std::vector<Connection>> children_;  // of the root first
    std::vector<std::vector<Connection>> parents_;
    Properties settings_;
};

/// A name without its class: "Hips" from "Model::Hips" and from "Hips\0\1Model".
[[nodiscard]] std::string plainName(std::string_view full);

}  // namespace lutka::animation::rig_import::fbx
