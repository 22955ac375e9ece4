/* page_calls.h: calls of the page to the WebAssembly module: one open scene, drawn in steps;
 * files; the tool's verbs. */
#ifndef PAGE_CALLS_H
#define PAGE_CALLS_H

#include <stddef.h>
#include <stdint.h>

#include <lambent/lambent.h>

#ifdef __wasm__
#define PAGE_CALL(name) __attribute__((export_name(#name)))
#else
#define PAGE_CALL(name)
#endif

/* page_take, page_give: allocate and free memory for arguments. page_ready: returns whether the
 * build draws the right pixels. */
PAGE_CALL(page_take) void *page_take(size_t bytes);
PAGE_CALL(page_give) void page_give(void *memory);
PAGE_CALL(page_ready) int page_ready(void);

/* page_use_kernels: uses the kernels of another module: their struct is at `words`, and their functions are in this
 * module's table from `first_function` on. Call it before you draw anything. */
PAGE_CALL(page_use_kernels) void page_use_kernels(const uint32_t *words, uint32_t first_function);

/* page_use_demo: sets the two functions of the built-in scene, in this module's table. */
PAGE_CALL(page_use_demo)
void page_use_demo(const lmb_scene *(*its_scene)(void), lmb_view (*its_view)(int32_t width, int32_t height));

/* page_file_put: stores a file and replaces one with the same name. `data` is from page_take; the call takes ownership.
 * Returns 1, or 0: too many files, or the name is too long. */
PAGE_CALL(page_file_put) int page_file_put(const char *name, uint8_t *data, size_t size);
PAGE_CALL(page_file_data) const uint8_t *page_file_data(const char *name);
PAGE_CALL(page_file_size) size_t page_file_size(const char *name);
PAGE_CALL(page_file_drop) void page_file_drop(const char *name);

/* page_help: main loop of a helper. page_helpers: number of started helpers. page_take_helpers: uses those from now on;
 * returns the number of threads. */
PAGE_CALL(page_help) void page_help(void);
PAGE_CALL(page_helpers) int32_t page_helpers(void);
PAGE_CALL(page_take_helpers) int32_t page_take_helpers(void);

/* `words` are a command line of the tool, a word a line. page_run: runs `relight`, `relief` or `mix`; returns the
 * exit status. page_open: loads `render`'s scene without drawing; it replaces the open scene. Returns 1, or 0 with
 * a message in page_report. */
PAGE_CALL(page_run) int page_run(const char *words);
PAGE_CALL(page_open) int page_open(const char *words);
PAGE_CALL(page_report) const char *page_report(void);

/* Numbers of the open scene: PAGE_NUMBERS doubles. */
enum {
    PAGE_WIDTH, PAGE_HEIGHT, PAGE_TRIANGLES, PAGE_LIGHTS, PAGE_BAKED, PAGE_THREADS,
    PAGE_EYE, PAGE_RIGHT = PAGE_EYE + 3, PAGE_UP = PAGE_RIGHT + 3, PAGE_BACK = PAGE_UP + 3,
    PAGE_HALF_WIDTH = PAGE_BACK + 3, PAGE_HALF_HEIGHT, PAGE_LOW, PAGE_HIGH = PAGE_LOW + 3,
    PAGE_LIGHT = PAGE_HIGH + 3, /* kind, position, direction of the selected light */
    PAGE_PROGRESS = PAGE_LIGHT + 7, PAGE_TRIM, PAGE_RMSE, PAGE_DROPPED, PAGE_MEMORY, PAGE_NUMBERS
};
PAGE_CALL(page_numbers) const double *page_numbers(uint32_t light);

/* page_look: moves the camera to the first point, towards the second. page_put_light: sets a light's position and
 * direction. Return 1, or 0 if refused. */
PAGE_CALL(page_look) int page_look(float ex, float ey, float ez, float tx, float ty, float tz);
PAGE_CALL(page_put_light) int page_put_light(uint32_t i, float x, float y, float z, float dx, float dy, float dz);

/* A frame. page_begin: `target` is one of PAGE_TO_; `show` is LMB_SHOW_*. page_step: draws at most `bands` bands;
 * returns 1: not done, 0: done, -1: see page_report. PAGE_TO_SCREEN uses the exposure of page_set_exposure;
 * page_exposure chooses one from the frame PAGE_TO_LINEAR, unless the options set one. page_to_pixels: converts that
 * frame for the screen. page_pixels: RGBA. */
enum { PAGE_TO_SCREEN, PAGE_TO_LINEAR, PAGE_TO_BEST };
PAGE_CALL(page_begin) int page_begin(int target, int show);
PAGE_CALL(page_step) int page_step(int bands);
PAGE_CALL(page_exposure) float page_exposure(void);
PAGE_CALL(page_set_exposure) void page_set_exposure(float ev);
PAGE_CALL(page_exposure_now) float page_exposure_now(void);
PAGE_CALL(page_to_pixels) int page_to_pixels(void);
PAGE_CALL(page_pixels) uint8_t *page_pixels(void);
PAGE_CALL(page_hash) const char *page_hash(void);

/* page_measure: computes PAGE_TRIM and PAGE_RMSE of the linear frame against the best one. Returns 1, or 0. */
PAGE_CALL(page_measure) int page_measure(void);

/* page_show: draws a picture other than light, if the scene was opened for one: RGBA, page_show_width pixels a row and
 * page_show_height rows. Returns NULL with a message in page_report. */
PAGE_CALL(page_show) uint8_t *page_show(void);
PAGE_CALL(page_show_width) int32_t page_show_width(void);
PAGE_CALL(page_show_height) int32_t page_show_height(void);

/* page_cut: returns the nodes of the finished frame that light the surface at a pixel, PAGE_NODE floats each: position,
 * radius, light, share of the pixels that see it, level, the light's face, and the texel in the face. page_cut_count:
 * the number of nodes; 0 if the frame uses no cuts. */
enum { PAGE_NODE = 10 };
PAGE_CALL(page_cut) const float *page_cut(int32_t x, int32_t y);
PAGE_CALL(page_cut_count) int32_t page_cut_count(void);
PAGE_CALL(page_cut_size) int32_t page_cut_size(void);

#endif
