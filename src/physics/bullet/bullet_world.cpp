#include "physics/bullet/bullet_world.hpp"
