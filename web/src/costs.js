// The gutter of costs: each line's share of the machine's cycles. A click asks for it.

import { GutterMarker, gutter } from "@codemirror/view";
import { RangeSet, StateEffect, StateField } from "@codemirror/state";

const put = StateEffect.define();

class Cost extends GutterMarker {
  constructor(share) {
    super();
    this.share = share;
  }
  eq(other) {
    return other.share === this.share;
  }
  toDOM() {
    const place = document.createElement("span");
    place.className = "cost";
    place.style.setProperty("--heat-part", Math.min(1, this.share).toFixed(3));
    const percent = 100 * this.share;
    place.textContent = percent < 0.05 ? "·" : percent.toFixed(percent < 9.95 ? 1 : 0) + "%";
    return place;
  }
}

const marks = StateField.define({
  create: () => RangeSet.empty,
  update(all, change) {
    all = all.map(change.changes);
    for (const effect of change.effects) {
      if (!effect.is(put)) continue;
      const found = [];
      for (const { line, share } of effect.value) {
        if (line < 1 || line > change.state.doc.lines) continue;
        found.push(new Cost(share).range(change.state.doc.line(line).from));
      }
      all = RangeSet.of(found, true);
    }
    return all;
  },
});

// `clicked` is told the number of the line.
export function costs(clicked) {
  return [
    marks,
    gutter({
      class: "cm-costs",
      markers: (view) => view.state.field(marks),
      domEventHandlers: {
        click(view, block) {
          clicked(view.state.doc.lineAt(block.from).number);
          return true;
        },
      },
    }),
  ];
}

// Shows shares of lines: [{ line, share }], or none.
export function showCosts(view, lines) {
  view.dispatch({ effects: put.of([...lines].sort((a, b) => a.line - b.line)) });
}
