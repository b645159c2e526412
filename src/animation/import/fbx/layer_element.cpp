#include "animation/import/fbx/layer_element.hpp"

#include <string_view>

namespace lutka::animation::rig_import::fbx {
namespace {

// Far outside any array.
constexpr std::size_t kNowhere = std::size_t{1} << 40U;

}  // namespace

LayerElement::LayerElement(const Record& record, const char* values, const char* indices, std::size_t width)
    : values_(record.numbersOf(values)) {
    const Record* mapping = record.child("MappingInformationType");
    const std::string_view how = mapping != nullptr ? mapping->text(0) : std::string_view{};
    if (how == "ByVertice" || how == "ByVertex" || how == "ByControlPoint")
        mapping_ = Mapping::controlPoint;
    else if (how == "ByPolygon")
        mapping_ = Mapping::polygon;
    else if (how == "AllSame")
        mapping_ = Mapping::same;
    const Record* reference = record.child("ReferenceInformationType");
    const bool direct = reference == nullptr || reference->text(0) == "Direct";
    if (!direct) indices_ = record.numbersOf(indices);
    if (values_.size() < width) values_.clear();
}

std::size_t LayerElement::indexAt(const Corner& corner) const {
    std::size_t place = 0;
    switch (mapping_) {
        case Mapping::corner:
            place = corner.place;
            break;
        case Mapping::controlPoint:
            place = corner.controlPoint;
            break;
        case Mapping::polygon:
            place = corner.polygon;
            break;
        case Mapping::same:
            break;
    }
    if (indices_.empty()) return place;
    if (place >= indices_.size() || !(indices_[place] >= 0.0 && indices_[place] < 1e9)) return kNowhere;
    return static_cast<std::size_t>(indices_[place]);
}

}  // namespace lutka::animation::rig_import::fbx
