/* ref_draw.h: fixed-function drawing against a slow evaluation in binary64. */
#ifndef REF_DRAW_H
#define REF_DRAW_H

/* ref_draw_lines: which pixels lines and points have. ref_draw_blends: codes after each pair of factors. ref_draw_fogs:
 * fog and colours across perspective. Each prints a line of figures and counts its checks. */
void ref_draw_lines(void);
void ref_draw_blends(void);
void ref_draw_fogs(void);

#endif
