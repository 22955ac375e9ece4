/* ref_draw.h: compares fixed-function drawing with a slow evaluation in binary64. */
#ifndef REF_DRAW_H
#define REF_DRAW_H

/* ref_draw_lines: pixels of lines and points. ref_draw_blends: codes after each pair of factors. ref_draw_fogs: fog and
 * colours in perspective. Each prints a line of figures and counts checks. */
void ref_draw_lines(void);
void ref_draw_blends(void);
void ref_draw_fogs(void);

#endif
