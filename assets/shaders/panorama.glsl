// Where a direction lies in an equirectangular picture, as panoramaUv() in src/render/environment.hpp.
vec2 panoramaUv(vec3 direction) {
    return vec2(atan(direction.x, -direction.z) / 6.2831853 + 0.5, acos(clamp(direction.y, -1.0, 1.0)) / 3.14159265);
}
