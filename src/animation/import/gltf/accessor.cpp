#include "animation/import/gltf/accessor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <type_traits>

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxElements = 50'000'000;
// An accessor without data costs no bytes in the file; a real one of this kind is the base of a sparse one.
constexpr std::size_t kMaxElementsOfNothing = 2'000'000;

enum class Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

std::size_t bytesOf(Component component) {
    switch (component) {
        case Component::i8:
        case Component::u8:
            return 1;
        case Component::i16:
        case Component::u16:
            return 2;
        case Component::u32:
        case Component::f32:
            return 4;
    }
    return 4;
}

Component componentOf(const json& object) {
    const std::size_t code = sizeOf(object, "componentType", 0);
    if (code < 5120 || code == 5124 || code > 5126)
        throw Damage{fmt::format("an accessor has the component type {}, which glTF does not know", code)};
    return static_cast<Component>(code);
}

struct Shape {
    std::size_t width = 1;
    std::size_t rows = 0;  // of a matrix, whose columns start at multiples of four bytes; 0: no matrix
};

Shape shapeOf(const std::string& type) {
    if (type == "SCALAR") return {1, 0};
    if (type == "VEC2") return {2, 0};
    if (type == "VEC3") return {3, 0};
    if (type == "VEC4") return {4, 0};
    if (type == "MAT2") return {4, 2};
    if (type == "MAT3") return {9, 3};
    if (type == "MAT4") return {16, 4};
    throw Damage{fmt::format("an accessor has the type '{}', which glTF does not know", type)};
}

template <class T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

template <class T>
float converted(const std::uint8_t* bytes, bool normalised) {
    const T value = load<T>(bytes);
    return normalised ? fraction(value) : static_cast<float>(value);
}

float numberAt(const std::uint8_t* bytes, Component component, bool normalised) {
    switch (component) {
        case Component::i8:
            return converted<std::int8_t>(bytes, normalised);
        case Component::u8:
            return converted<std::uint8_t>(bytes, normalised);
        case Component::i16:
            return converted<std::int16_t>(bytes, normalised);
        case Component::u16:
            return converted<std::uint16_t>(bytes, normalised);
        case Component::u32:
            return converted<std::uint32_t>(bytes, normalised);
        case Component::f32:
            return load<float>(bytes);
    }
    return 0.0F;
}

std::uint32_t integerAt(const std::uint8_t* bytes, Component component) {
    switch (component) {
        case Component::i8:
        case Component::u8:
            return load<std::uint8_t>(bytes);
        case Component::i16:
        case Component::u16:
            return load<std::uint16_t>(bytes);
        case Component::u32:
            return load<std::uint32_t>(bytes);
        case Component::f32: {  // some exporters write joints as floats
            const float value = load<float>(bytes);
            return value >= 0.0F && value < 4e9F ? static_cast<std::uint32_t>(value) : 0U;
        }
    }
    return 0;
}

// Where the elements of an accessor lie.
struct Layout {
    Component component = Component::f32;
    Shape shape;
    std::size_t count = 0;
    bool normalised = false;

    [[nodiscard]] std::size_t offsetOf(std::size_t component_) const {
        if (shape.rows == 0) return component_ * bytesOf(component);
        const std::size_t column = (shape.rows * bytesOf(component) + 3) / 4 * 4;
        return component_ / shape.rows * column + component_ % shape.rows * bytesOf(component);
    }
    [[nodiscard]] std::size_t elementBytes() const { return offsetOf(shape.width - 1) + bytesOf(component); }
};

Layout layoutOf(const json& accessor) {
    Layout layout;
    layout.component = componentOf(accessor);
    layout.shape = shapeOf(textOf(accessor, "type"));
    layout.count = sizeOf(accessor, "count", 0);
    layout.normalised = truthOf(accessor, "normalized", false);
    if (layout.count > kMaxElements) throw Damage{fmt::format("an accessor has more than {} elements", kMaxElements)};
    return layout;
}

// Elements in a buffer view.
struct Elements {
    const std::uint8_t* first = nullptr;
    std::size_t stride = 0;  // bytes from one to the next

    [[nodiscard]] const std::uint8_t* at(std::size_t element) const { return first + element * stride; }
};

// `count` elements of the view that `place` names. Throws where it ends before they do.
Elements elementsAt(GltfFile& file, const json& place, std::size_t count, std::size_t elementBytes) {
    const std::optional<int> view = indexOf(place, "bufferView", file.count("bufferViews"));
    if (!view) throw Damage{"sparse data without a buffer view"};
    const std::span<const std::uint8_t> bytes = file.viewBytes(*view);
    const std::size_t offset = sizeOf(place, "byteOffset", 0);
    const json& source = file.element("bufferViews", *view);
    const json* packed = extensionOf(source, "EXT_meshopt_compression");
    if (packed == nullptr) packed = extensionOf(source, "KHR_meshopt_compression");
    std::size_t stride = sizeOf(packed != nullptr ? *packed : source, "byteStride", 0);
    if (stride == 0) stride = elementBytes;
    if (count == 0) return {};
    // By division: a stride may be any number, and the product beyond all numbers.
    const bool holdsOne = offset <= bytes.size() && elementBytes <= bytes.size() - offset;
    if (!holdsOne || (bytes.size() - offset - elementBytes) / stride < count - 1)
        throw Damage{fmt::format("buffer view {} ends before its accessor's {} elements do", *view, count)};
    return {bytes.data() + offset, stride};
}

// The elements of the accessor's own view; nothing where it has none. Bounds the count before anything is made that
// large.
std::optional<Elements> elementsOf(GltfFile& file, const json& accessor, const Layout& layout) {
    if (member(accessor, "bufferView") != nullptr)
        return elementsAt(file, accessor, layout.count, layout.elementBytes());
    if (layout.count > kMaxElementsOfNothing)
        throw Damage{fmt::format("an accessor of {} elements has no data", layout.count)};
    return std::nullopt;
}

// Calls `take(element, bytes of it)` for the elements that a sparse accessor replaces.
template <class Take>
void readSparse(GltfFile& file, const json& accessor, const Layout& layout, const Take& take) {
    const json* sparse = member(accessor, "sparse");
    if (sparse == nullptr) return;
    const json* indices = member(*sparse, "indices");
    const json* values = member(*sparse, "values");
    const std::size_t count = sizeOf(*sparse, "count", 0);
    if (indices == nullptr || values == nullptr || count > layout.count) throw Damage{"a sparse accessor is damaged"};
    const Component component = componentOf(*indices);
    const Elements places = elementsAt(file, *indices, count, bytesOf(component));
    const Elements replaced = elementsAt(file, *values, count, layout.elementBytes());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t place = integerAt(places.at(i), component);
        if (place < layout.count) take(place, replaced.at(i));
    }
}

void checkWidth(std::size_t has, std::size_t wanted, const char* what) {
    if (has != wanted) throw Damage{fmt::format("{} have {} components instead of {}", what, has, wanted)};
}

}  // namespace

Numbers readNumbers(GltfFile& file, int accessor) {
    const json& source = file.element("accessors", accessor);
    const Layout layout = layoutOf(source);
    const std::optional<Elements> elements = elementsOf(file, source, layout);
    const std::size_t width = layout.shape.width;
    Numbers numbers;
    numbers.count = layout.count;
    numbers.width = width;
    numbers.values.assign(layout.count * width, 0.0F);
    const bool plain = layout.component == Component::f32;  // without gaps, matrices' columns too
    const auto take = [&](std::size_t element, const std::uint8_t* bytes) {
        float* const out = &numbers.values[element * width];
        if (plain) std::memcpy(out, bytes, width * sizeof(float));
        for (std::size_t i = 0; i < width && !plain; ++i)
            out[i] = numberAt(bytes + layout.offsetOf(i), layout.component, layout.normalised);
    };
    if (elements && plain && elements->stride == width * sizeof(float)) {
        std::memcpy(numbers.values.data(), elements->first, numbers.values.size() * sizeof(float));
    } else if (elements) {
        for (std::size_t element = 0; element < layout.count; ++element)
            take(element, elements->at(element));
    }
    readSparse(file, source, layout, take);
    return numbers;
}

Numbers readNumbers(GltfFile& file, int accessor, std::size_t width, const char* what) {
    checkWidth(shapeOf(textOf(file.element("accessors", accessor), "type")).width, width, what);
    return readNumbers(file, accessor);
}

std::vector<std::uint32_t> readIntegers(GltfFile& file, int accessor, std::size_t width, const char* what) {
    const json& source = file.element("accessors", accessor);
    const Layout layout = layoutOf(source);
    checkWidth(layout.shape.width, width, what);
    const std::optional<Elements> elements = elementsOf(file, source, layout);
    std::vector<std::uint32_t> integers(layout.count * width, 0U);
    const auto take = [&](std::size_t element, const std::uint8_t* bytes) {
        for (std::size_t i = 0; i < width; ++i)
            integers[element * width + i] = integerAt(bytes + layout.offsetOf(i), layout.component);
    };
    for (std::size_t element = 0; elements && element < layout.count; ++element)
        take(element, elements->at(element));
    readSparse(file, source, layout, take);
    return integers;
}

}  // namespace lutka::animation::rig_import::gltf
