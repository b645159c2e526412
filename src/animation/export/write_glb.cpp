#include "animation/export/write_glb.hpp"
