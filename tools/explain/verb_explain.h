/* verb_explain.h: `lambent explain`. */
#ifndef VERB_EXPLAIN_H
#define VERB_EXPLAIN_H

int verb_explain(int argc, char **argv);

#endif
