/* verb_merge.h: `lambent merge`. */
#ifndef VERB_MERGE_H
#define VERB_MERGE_H

int verb_merge(int argc, char **argv);

#endif
