#include "animation/export/write_obj.hpp"
