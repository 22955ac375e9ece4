# examples.sh: checks that the examples of each verb's help work when pasted, except for doctor and explain.sh's.
. tests/cli/common.sh

pasted render play capture relight relief "relief bake" "relief render" mix pack merge plan compare info

finish
