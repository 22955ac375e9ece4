/* lambent.h: the whole public face. Read types.h first, then render.h for one call that does everything. */
#ifndef LMB_LAMBENT_H
#define LMB_LAMBENT_H

#include "config.h"
#include "types.h"
#include "numbers.h"
#include "surface.h"
#include "scene.h"
#include "raster.h"
#include "bins.h"
#include "map.h"
#include "occlusion.h"
#include "light.h"
#include "many_lights.h"
#include "bounce.h"
#include "tree.h"
#include "live.h"
#include "elements.h"
#include "voxel.h"
#include "probe.h"
#include "env.h"
#include "relief.h"
#include "transfer.h"
#include "pack.h"
#include "gouraud.h"
#include "fixed.h"
#include "mixed.h"
#include "compose.h"
#include "relight.h"
#include "render.h"
#include "plan.h"

#endif
