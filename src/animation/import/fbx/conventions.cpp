#include "animation/import/fbx/conventions.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <string>

namespace lutka::animation::rig_import::fbx {
namespace {

struct Axis {
    int axis;
    double sign;
};

std::optional<Axis> axisOf(const Properties& settings, const std::string& name) {
    const std::int64_t axis = settings.integer(name, -1);
    if (axis < 0 || axis > 2) return std::nullopt;
    return Axis{static_cast<int>(axis), settings.integer(name + "Sign", 1) < 0 ? -1.0 : 1.0};
}

}  // namespace

Conventions conventionsOf(const Properties& settings) {
    Conventions out;
    const double centimetres = settings.number("UnitScaleFactor", 0.0);
    if (centimetres > 0.0 && std::isfinite(centimetres)) {
        out.stated.metresPerUnit = 0.01 * centimetres;
        out.stated.unitSource = "FBX UnitScaleFactor";
    }
    const std::optional<Axis> up = axisOf(settings, "UpAxis");
    if (!up) return out;
    out.stated.up = static_cast<UpAxis>(2 * up->axis + (up->sign > 0.0 ? 0 : 1));
    out.stated.upSource = "FBX UpAxis";
    const std::optional<Axis> front = axisOf(settings, "FrontAxis");
    const std::optional<Axis> right = axisOf(settings, "CoordAxis");
    if (!front || !right || front->axis == up->axis || front->axis == right->axis || right->axis == up->axis)
        return out;
    dmat3 sceneFromFile(0.0);
    sceneFromFile[right->axis].x = right->sign;
    sceneFromFile[up->axis].y = up->sign;
    sceneFromFile[front->axis].z = front->sign;
    if (glm::determinant(sceneFromFile) < 0.0) {
        out.sceneFromFile = dmat4(sceneFromFile);
        out.stated.up = UpAxis::positiveY;
    }
    return out;
}

}  // namespace lutka::animation::rig_import::fbx
