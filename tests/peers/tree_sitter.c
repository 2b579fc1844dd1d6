// Scenes as editors with tree-sitter see them: tree_sitter QUERY FILE..., linked with the
// grammar's parser.c and libtree-sitter. Prints where a tree has an error, and then each of the
// query's captures and how often it occurs. Exit status 1 where a tree has an error, 2 where the
// parser, the query or a file cannot be used.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <tree_sitter/api.h>

const TSLanguage *tree_sitter_slowlight(void);

static void give_up(const char *what, const char *why) {
  fprintf(stderr, "%s: %s\n", what, why);
  exit(2);
}

// A whole file; `size` takes its bytes.
static char *read_file(const char *path, uint32_t *size) {
  FILE *file = fopen(path, "rb");
  if (!file) give_up(path, "cannot be opened");
  size_t room = 1 << 16, used = 0, got;
  char *text = malloc(room);
  while (text && (got = fread(text + used, 1, room - used, file)) > 0) {
    used += got;
    if (used == room) text = realloc(text, room *= 2);
  }
  if (!text || ferror(file)) give_up(path, "cannot be read");
  fclose(file);
  *size = (uint32_t)used;
  return text;
}

// Prints where the errors below a node are. An error's symbol is -1 (older libraries have no
// function that tells).
static void print_errors(const char *path, TSNode node) {
  if (ts_node_is_missing(node) || ts_node_symbol(node) == (TSSymbol)-1) {
    TSPoint at = ts_node_start_point(node);
    const char *what = ts_node_is_missing(node) ? "missing" : "not understood";
    printf("%s:%u:%u: %s: %s\n", path, at.row + 1, at.column + 1, what, ts_node_type(node));
    return;
  }
  for (uint32_t k = 0; k < ts_node_child_count(node); k++) {
    TSNode child = ts_node_child(node, k);
    if (ts_node_has_error(child)) print_errors(path, child);
  }
}

static TSQuery *read_query(const char *path) {
  uint32_t size, at;
  TSQueryError error;
  char *text = read_file(path, &size);
  TSQuery *query = ts_query_new(tree_sitter_slowlight(), text, size, &at, &error);
  if (!query) {
    fprintf(stderr, "%s: error %d at byte %u\n", path, (int)error, at);
    exit(2);
  }
  free(text);
  return query;
}

// Adds to `counts` how often each capture occurs below a node.
static void count_captures(const TSQuery *query, TSNode root, unsigned long *counts) {
  TSQueryCursor *cursor = ts_query_cursor_new();
  TSQueryMatch match;
  uint32_t k;
  ts_query_cursor_exec(cursor, query, root);
  while (ts_query_cursor_next_capture(cursor, &match, &k)) counts[match.captures[k].index]++;
  ts_query_cursor_delete(cursor);
}

int main(int argc, char **argv) {
  if (argc < 3) give_up(argv[0], "QUERY FILE...");
  TSParser *parser = ts_parser_new();
  if (!ts_parser_set_language(parser, tree_sitter_slowlight()))
    give_up("parser.c", "made for another version of libtree-sitter");
  TSQuery *query = read_query(argv[1]);
  uint32_t captures = ts_query_capture_count(query);
  unsigned long *counts = calloc(captures + 1, sizeof *counts);
  int wrong = 0;
  for (int k = 2; k < argc; k++) {
    uint32_t size;
    char *text = read_file(argv[k], &size);
    TSTree *tree = ts_parser_parse_string(parser, NULL, text, size);
    if (!tree) give_up(argv[k], "cannot be parsed");
    TSNode root = ts_tree_root_node(tree);
    if (ts_node_has_error(root)) {
      wrong = 1;
      print_errors(argv[k], root);
    }
    count_captures(query, root, counts);
    ts_tree_delete(tree);
    free(text);
  }
  for (uint32_t k = 0; k < captures; k++) {
    uint32_t length;
    const char *name = ts_query_capture_name_for_id(query, k, &length);
    printf("%s %lu\n", name, counts[k]);
  }
  free(counts);
  ts_query_delete(query);
  ts_parser_delete(parser);
  return wrong;
}
