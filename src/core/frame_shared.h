// What every station must know of a frame: camera, bounds, film. Passed by value to the kernels.
// Eye space here: x right, y up, z the DEPTH along the view axis (positive in front of the eye).
#ifndef TESSERA_CORE_FRAME_SHARED_H
#define TESSERA_CORE_FRAME_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

typedef struct {
    // Camera.
    float focal;       // pixels: screen x = centre_x + focal * x / depth
    float centre_x;    // pixels
    float centre_y;    // pixels
    float near_plane;  // scene units
    float far_cull;    // scene units: ranges wholly beyond are culled
    // Bounds of the picture with the ribbon, pixels from the left and from the BOTTOM (y up).
    float cull_left;
    float cull_right;
    float cull_bottom;
    float cull_top;
    // Splitting and dicing.
    float split_bound;  // pixels
    uint max_depth;     // splits
    uint dice_rate;     // micropolygons along a side of a range
    uint rate_bits;     // of a micropolygon's row or column in an id: 2^rate_bits >= dice_rate
    // Splitting and dicing in watertight mode.
    uint watertight;      // 0 or 1: which mode it is
    float dicing_focal;   // pixels, and
    float dicing_near;    // scene units: of the dicing camera
    float dicing_across;  // depth per x, and per y, at which a point is seen a picture's width, or height, from the axis
    float dicing_up;
    float dicing_length;  // pixels: greatest length of a micropolygon's edge
    uint grid_bits;       // edges have at most 2^grid_bits micropolygons
    uint level_most;      // cuts in one direction
    uint dicing_apart;    // 0 or 1: whether the dicing camera is another
    // Patches, by kind: Bezier, Gregory from bezier_patches on, rational from gregory_end on, PN triangles from rational_end on.
    uint bezier_patches;
    uint gregory_end;
    uint rational_end;
    uint patches;
    uint first_patch;  // of these, in the scene: what references count from
    uint streamed;     // 0 or 1: whether other patches come after these on the device, so that every batch is resolved
    // What is fed, and what is culled behind what is drawn.
    uint feed_boxes;  // 0 or 1: whether patches whose boxes miss the film's tiles of 8 x 8 pixels are left out, these included:
    int box_x0;
    int box_x1;
    int box_y0;
    int box_y1;
    uint occlusion;  // 0 or 1: ranges behind what is drawn are culled; with feed_boxes, patches are fed from front to back
    // Film, which holds a bucket of the crop window, or all of it. In cells: a cell holds one sample, pixel_samples x pixel_samples cells
    // make a pixel.
    int pixel_samples;
    int cells_x;  // of the bucket
    int cells_y;
    int cell_x0;  // the bucket's corner in the full picture
    int cell_y0;
    int tile_cells;      // cells along a side of a tile; a multiple of pixel_samples
    float tile_inverse;  // 1 / tile_cells
    int tiles_x;
    int tiles;
    int width;  // of the bucket, pixels
    int height;
    // Raster coordinates: 24.8 fixed point in cells, from the bucket's top left, y down.
    float raster_scale;  // focal * pixel_samples * 256
    float raster_x;      // centre of the full picture in 1/256 cells
    float raster_y;
    int raster_x0;  // the bucket's corner in 1/256 cells
    int raster_y0;
    uint cull_backfaces;  // 0 or 1
    // Shading.
    uint lights;
    float background_r;  // premultiplied
    float background_g;
    float background_b;
    float background_a;
    float world_from_eye[9];  // rotation, row by row
} frame_params;

TESSERA_SHARED_END

#endif
