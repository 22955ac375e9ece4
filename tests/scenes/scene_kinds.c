/* scene_kinds.c: the table of kinds. The truth of a held-out kind measures lambent's accuracy, and never chooses a
 * constant. A fitted kind was used when constants were chosen; seeds from 100 on (`louvres:107`) are held out. */
#include "scenes.h"

enum { FITTED, HELD_OUT };

const scene_kind scene_kinds[] = {
    {"louvres", FITTED, build_louvres, "a room divided by thirty slats"},
    {"stair_hall", FITTED, build_stair_hall, "two flights of stairs with posts"},
    {"attic", FITTED, build_attic, "sun patches through roof windows"},
    {"bookshelves", FITTED, build_bookshelves, "some 400 books"},
    {"foliage", FITTED, build_foliage, "2,000 leaves in the sun"},
    {"columns", FITTED, build_columns, "a hall of twelve columns"},
    {"windows", FITTED, build_windows, "sun through forty small windows"},
    {"canyon", FITTED, build_canyon, "20,000 triangles of rock in the sun"},
    {"gallery", FITTED, build_gallery, "long, with niches, lit at one end"},
    {"terrain_out", FITTED, build_terrain_out, "a house on 4 km of land, from outside"},
    {"pipes", FITTED, build_pipes, "forty tubes across a room"},
    {"city", FITTED, build_city, "a hundred houses in the sun"},
    {"tent", FITTED, build_tent, "a closed box with a hole of 0.3 m for the sun"},
    {"l_corridor", FITTED, build_l_corridor, "a lamp behind the corner"},
    {"kitchen", FITTED, build_kitchen, "cupboards, table, chairs, a sunlit window"},
    {"grille", FITTED, build_grille, "a spot behind iron bars"},
    {"blinds", FITTED, build_blinds, "sun through a blind of 24 slats"},
    {"railing", FITTED, build_railing, "a gallery with a railing, lit from above"},
    {"doors", HELD_OUT, build_doors, "four rooms that follow one another"},
    {"furnished", FITTED, build_furnished, "a point light in a lampshade"},
    {"spiral", HELD_OUT, build_spiral, "a winding stair in a shaft"},
    {"arcade", FITTED, build_arcade, "arches under a barrel vault"},
    {"courtyard", HELD_OUT, build_courtyard, "arcades round a court in the sun"},
    {"cave", HELD_OUT, build_cave, "rough walls, a spot"},
    {"crates", HELD_OUT, build_crates, "sixty crates that lie at every angle"},
    {"reeds", HELD_OUT, build_reeds, "900 blades before a wall"},
    {"foliage20k", HELD_OUT, build_foliage20k, "20,000 leaves in the sun"},
    {"terrain_in", HELD_OUT, build_terrain_in, "the house on 4 km of land, from inside"},
    {"small_room", HELD_OUT, build_small_room, "a spot on a wall, two crates"},
    {"small_stairs", HELD_OUT, build_small_stairs, "nine steps under a lamp"},
    {"small_shelf", FITTED, build_small_shelf, "boxes on boards, in a spot that comes in aslant"},
    {"doorway", HELD_OUT, build_doorway, "a lit room behind a door and a screen"},
    {"leaves", HELD_OUT, build_leaves, "40 large leaves in the sun"},
    {"glow", HELD_OUT, build_glow, "a panel that emits light"},
    {"alcove", HELD_OUT, build_alcove, "a lamp in a side room: light by two bounces"},
};

const int scene_kind_count = COUNT_OF(scene_kinds);
