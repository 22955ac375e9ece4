/* process.c: copies of this program by fork, controlled through pipes; not available elsewhere. */
#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* fork, pipe */
#endif
#include "process.h"

#ifdef _WIN32

int process_start(process *out, process_job job, void *user)
{
    (void)out;
    (void)job;
    (void)user;
    return 0;
}

int process_go(const process *p) { return (void)p, 0; }
int process_wait(const process *p) { return (void)p, 0; }
void process_end(const process *p) { (void)p; }

#else

#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STOP = 0, GO = 1 };

/* Main loop of the copy. A word ends it, because a later copy may keep the pipe open. */
static void serve(int go, int done, process_job job, void *user)
{
    char word = GO;
    do {
        job(user);
    } while (write(done, &word, 1) == 1 && read(go, &word, 1) == 1 && word == GO);
    _exit(0);
}

int process_start(process *out, process_job job, void *user)
{
    int go[2], done[2];
    signal(SIGPIPE, SIG_IGN);
    if (pipe(go) != 0) {
        return 0;
    }
    if (pipe(done) != 0) {
        close(go[0]);
        close(go[1]);
        return 0;
    }
    const pid_t id = fork();
    if (id == 0) {
        close(go[1]);
        close(done[0]);
        serve(go[0], done[1], job, user);
    }
    close(go[0]);
    close(done[1]);
    out->go = go[1];
    out->done = done[0];
    out->id = (int)id;
    if (id > 0 && process_wait(out)) {
        return 1;
    }
    process_end(out);
    return 0;
}

static int say(const process *p, char word) { return write(p->go, &word, 1) == 1; }

int process_go(const process *p) { return say(p, GO); }

int process_wait(const process *p)
{
    char word;
    return read(p->done, &word, 1) == 1;
}

void process_end(const process *p)
{
    say(p, STOP);
    close(p->go);
    close(p->done);
    if (p->id > 0) {
        waitpid((pid_t)p->id, NULL, 0);
    }
}

#endif
