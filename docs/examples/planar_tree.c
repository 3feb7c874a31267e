/* An engine as a program: accelerations of any planar tree of links, over furiko's engine protocol, in plain C.

   cc -O2 -o planar_tree planar_tree.c -lm         furiko check -e ./planar_tree

   Messages come on standard input and answers go to standard output; docs/reference/engine-protocol.md says how. The
   texts are furiko's own and small, so that looking for a key in them is enough here; a larger program takes a JSON
   library. The byte order is that of little-endian machines. */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 64 /* links, and models at a time */

typedef struct { int parent; double hinge[2], com[2], mass, inertia; } Link;
typedef struct { int n, number; double gravity; Link links[MOST]; } Model;

static Model models[MOST];

/* ---- frames: "furiko", 1, newline; length (8 bytes) and CRC-32 (4), highest byte first; the content ---- */

static uint32_t crc(const unsigned char *bytes, size_t size) {
    uint32_t value = 0xFFFFFFFFu;
    for (size_t i = 0; i < size; i++) {
        value ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) value = (value >> 1) ^ (0xEDB88320u & -(value & 1));
    }
    return ~value;
}

static uint64_t number(const unsigned char *bytes, int size) {
    uint64_t value = 0;
    for (int i = 0; i < size; i++) value = value << 8 | bytes[i];
    return value;
}

static void put(unsigned char *bytes, int size, uint64_t value) {
    for (int i = size - 1; i >= 0; i--, value >>= 8) bytes[i] = (unsigned char)value;
}

static unsigned char *receive(size_t *size) {
    unsigned char head[20], *content;
    if (fread(head, 1, 20, stdin) != 20 || memcmp(head, "furiko\1\n", 8)) return NULL;
    *size = number(head + 8, 8);
    if (*size > (1u << 28) || !(content = malloc(*size + 1))) return NULL;
    if (fread(content, 1, *size, stdin) != *size || crc(content, *size) != number(head + 16, 4)) exit(1);
    content[*size] = 0;
    return content;
}

/* The content: length of the text (4 bytes), the text, the numbers of its arrays. */
static void answer(const char *text, const double *numbers, size_t count) {
    size_t length = strlen(text), size = 4 + length + 8 * count;
    unsigned char *bytes = malloc(20 + size);
    memcpy(bytes, "furiko\1\n", 8);
    put(bytes + 20, 4, length);
    memcpy(bytes + 24, text, length);
    if (count) memcpy(bytes + 24 + length, numbers, 8 * count);
    put(bytes + 8, 8, size);
    put(bytes + 16, 4, crc(bytes + 20, size));
    fwrite(bytes, 1, 20 + size, stdout);
    fflush(stdout);
    free(bytes);
}

/* ---- the mechanics: absolute angles; M and the forces from where each centre of mass is ---- */

static void accelerate(const Model *model, const double *theta, const double *omega, double *alpha) {
    static double m[MOST][MOST], f[MOST];
    int n = model->n;
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) m[j][k] = 0;
        m[j][j] = model->links[j].inertia;
        f[j] = 0;
    }
    for (int i = 0; i < n; i++) {
        int above[MOST], count = 0;
        double u[MOST][2], pull[2] = {0, 0}; /* velocity of the centre for each rate; its acceleration by the rates */
        const double *point = model->links[i].com;
        for (int j = i; j >= 0; point = model->links[j].hinge, j = model->links[j].parent) {
            double c = cos(theta[j]), s = sin(theta[j]), a = point[0], b = point[1];
            u[count][0] = a * c - b * s, u[count][1] = a * s + b * c;
            pull[0] -= omega[j] * omega[j] * (a * s + b * c), pull[1] -= omega[j] * omega[j] * (b * s - a * c);
            above[count++] = j;
        }
        for (int p = 0; p < count; p++) {
            double mass = model->links[i].mass;
            f[above[p]] -= mass * (u[p][0] * pull[0] + u[p][1] * (pull[1] + model->gravity));
            for (int q = 0; q < count; q++)
                m[above[p]][above[q]] += mass * (u[p][0] * u[q][0] + u[p][1] * u[q][1]);
        }
    }
    for (int j = 0; j < n; j++) { /* M = L Lt in place, then two triangles */
        for (int k = 0; k <= j; k++) {
            double sum = m[j][k];
            for (int i = 0; i < k; i++) sum -= m[j][i] * m[k][i];
            m[j][k] = j == k ? sqrt(sum) : sum / m[k][k];
        }
        for (int i = 0; i < j; i++) f[j] -= m[j][i] * f[i];
        f[j] /= m[j][j];
    }
    for (int j = n - 1; j >= 0; j--) {
        for (int i = j + 1; i < n; i++) f[j] -= m[i][j] * f[i];
        alpha[j] = f[j] /= m[j][j];
    }
}

/* ---- what is asked ---- */

static double value(const char **text, const char *key) {
    const char *found = strstr(*text, key);
    if (!found) return NAN;
    found += strlen(key);
    while (*found && strchr(" :[", *found)) found++;
    char *end;
    double number = strtod(found, &end);
    *text = end;
    return number;
}

static int build(const char *text) {
    const char *at = text;
    int number = (int)value(&at, "\"model\"");
    Model *model = NULL;
    for (int i = 0; i < MOST && !model; i++)
        if (!models[i].n) model = &models[i];
    if (!model) return 0;
    at = text;
    *model = (Model){.number = number, .gravity = value(&at, "\"gravity\"")};
    const char *links = strstr(text, "\"links\"");
    int n = 0;
    for (at = links; at && n < MOST && strstr(at, "\"parent\""); n++) {
        Link *link = &model->links[n];
        link->parent = (int)value(&at, "\"parent\"");
        link->hinge[0] = value(&at, "\"hinge\""), link->hinge[1] = value(&at, ",");
        link->com[0] = value(&at, "\"com\""), link->com[1] = value(&at, ",");
        link->mass = value(&at, "\"mass\""), link->inertia = value(&at, "\"inertia\"");
    }
    model->n = n;
    return n;
}

static Model *model_of(const char *text) {
    int number = (int)value(&text, "\"model\"");
    for (int i = 0; i < MOST; i++)
        if (models[i].n && models[i].number == number) return &models[i];
    return NULL;
}

static void ask(const char *text, const unsigned char *arrays, size_t size) {
    Model *model = model_of(text);
    if (!model || !strstr(text, "\"accelerations\"")) {
        answer("{\"say\": \"error\", \"kind\": \"failed\", \"what\": \"no such model or question\"}", NULL, 0);
        return;
    }
    size_t states = size / 16 / model->n;
    double *given = malloc(size + 8), *alpha = malloc(size / 2 + 8);
    memcpy(given, arrays, size); /* theta of all states, then omega */
    for (size_t b = 0; b < states; b++)
        accelerate(model, given + b * model->n, given + (states + b) * model->n, alpha + b * model->n);
    char head[120];
    snprintf(head, sizeof head, "{\"say\": \"answer\", \"arrays\": [[\"accelerations\", [%zu, %d]]]}", states, model->n);
    answer(head, alpha, states * model->n);
    free(given), free(alpha);
}

int main(void) {
    size_t size;
    for (unsigned char *content; (content = receive(&size)); free(content)) {
        size_t length = number(content, 4);
        if (size < 4 || length > size - 4) return 1;
        char *text = malloc(length + 1);
        memcpy(text, content + 4, length), text[length] = 0;
        if (strstr(text, "\"say\": \"hello\""))
            answer("{\"say\": \"hello\", \"protocol\": 1, \"version\": \"1.0\", \"questions\": [\"accelerations\"], "
                   "\"formulation\": \"centres of mass in absolute angles, Cholesky factors; in C\", "
                   "\"coordinates\": \"absolute\", \"largest_n\": 64}", NULL, 0);
        else if (strstr(text, "\"say\": \"build\""))
            answer(build(text) ? "{\"say\": \"built\"}"
                               : "{\"say\": \"error\", \"kind\": \"invalid\", \"what\": \"no place for this model\"}", NULL, 0);
        else if (strstr(text, "\"say\": \"drop\"")) {
            Model *model = model_of(text);
            if (model) model->n = 0;
            answer("{\"say\": \"dropped\"}", NULL, 0);
        } else
            ask(text, content + 4 + length, size - 4 - length);
        free(text);
    }
    return 0;
}
