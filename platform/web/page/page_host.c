/* page_host.c: host.h on a page: the browser's clock, and nothing to clean up. */
#include "../../../platform/host/host.h"

#include "page_calls.h"

__attribute__((import_module("env"), import_name("now"))) double page_now_ms(void);

double host_seconds(void) { return 1e-3 * page_now_ms(); }
double host_cpu_seconds(void) { return 1e-3 * page_now_ms(); }
int host_watched(void) { return 0; }
void host_processor(char *out, int size) { out[0] = size > 0 ? '\0' : out[0]; }
void host_make_folders(const char *path) { (void)path; }
void host_take_streams(void) {}
void host_end_cleanly(void (*clean)(void)) { (void)clean; }
void host_hold_signals(int is_held) { (void)is_held; }
void host_wipe_line(void) {}
void host_outlive_file_limit(void) {}
