"use strict";
// Plots that are drawn already become ones that can be asked: a line is shown or hidden by its legend, an engine alone by
// a list, and every point is said in words, to the mouse, a finger, and the arrow keys on a slider.
(() => {
  const NEAR = 40; // in the plot's units: a finger further off means no point

  function make(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  }

  /** Where the pointer is, in the drawing's units. */
  function placed(svg, event) {
    const matrix = svg.getScreenCTM();
    if (!matrix) return null;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    return [point.x, point.y];
  }

  function value(axis, place) {
    const [low, high, start, stop, log] = axis;
    const scaled = low + ((high - low) * (place - start)) / (stop - start);
    return log ? 10 ** scaled : scaled;
  }

  /** The points of a line: its marks with their words, else the corners of its path, read from the axes. */
  function pointsOf(line, plot) {
    const marks = [...line.querySelectorAll("use")];
    if (marks.length) return marks.map((mark) => ({ x: Number(mark.getAttribute("x")), y: Number(mark.getAttribute("y")), words: mark.textContent.trim() }));
    const path = line.querySelector("path")?.getAttribute("d") ?? "";
    return path.slice(1).split("L").filter(Boolean).map((pair) => {
      const [x, y] = pair.split(" ").map(Number);
      const said = [[plot.across, x], [plot.up, y]].map(([axis, at]) => String(Number(value(axis, at).toPrecision(3))));
      return { x, y, words: `${line.dataset.name}: ${plot.xLabel} ${said[0]}, ${plot.yLabel} ${said[1]}` };
    });
  }

  /** A slider over points, the ring that shows which, and what it says. */
  function pointer(svg, title, points, steps) {
    const now = make("output", { class: "said" });
    const slider = make("input", { type: "range", min: "0", step: "1", value: "0", "aria-label": `points of ${title}` });
    const ring = document.createElementNS(svg.namespaceURI, "circle");
    ring.setAttribute("class", "ring");
    svg.append(ring);
    let shown = [];

    function stand(number) {
      const point = shown[number];
      ring.setAttribute("r", point ? "9" : "0");
      if (!point) { now.textContent = "nothing is shown"; return; }
      slider.value = String(number);
      ring.setAttribute("cx", point.x);
      ring.setAttribute("cy", point.y);
      now.textContent = point.words;
      slider.setAttribute("aria-valuetext", point.words);
    }

    function fill() {
      shown = points();
      slider.max = String(Math.max(shown.length - 1, 0));
      slider.disabled = !shown.length;
      stand(Math.min(Number(slider.value), shown.length - 1));
      ring.setAttribute("r", "0"); // until somebody asks
      now.textContent = shown.length ? "Point at the plot, touch it, or move the slider with the arrow keys." : "nothing is shown";
    }

    function look(event) {
      const at = placed(svg, event);
      if (!at) return;
      let best = -1, nearest = NEAR;
      shown.forEach((point, number) => {
        const off = Math.hypot(point.x - at[0], point.y - at[1]);
        if (off < nearest) [best, nearest] = [number, off];
      });
      if (best >= 0) stand(best);
    }

    svg.addEventListener("pointermove", look);
    svg.addEventListener("pointerdown", look);
    slider.addEventListener("input", () => stand(Number(slider.value)));
    slider.addEventListener("keydown", (event) => {
      const step = { ArrowUp: 1, ArrowDown: -1, ArrowRight: steps, ArrowLeft: -steps }[event.key];
      if (!step) return;
      event.preventDefault();
      stand(Math.min(Math.max(Number(slider.value) + step, 0), shown.length - 1));
    });
    fill();
    return { parts: make("div", { class: "asked" }, slider, now), fill };
  }

  function chart(figure) {
    const svg = figure.querySelector("svg");
    const lines = [...svg.querySelectorAll("g.series")];
    const plot = { across: JSON.parse(svg.dataset.across), up: JSON.parse(svg.dataset.up), xLabel: svg.dataset.x, yLabel: svg.dataset.y };
    const points = lines.map((line) => pointsOf(line, plot));
    const visible = () => points.filter((_, i) => !lines[i].hasAttribute("hidden")).flat();
    const asked = pointer(svg, figure.querySelector("figcaption")?.textContent || svg.getAttribute("aria-label"), visible, 1);
    figure.append(asked.parts);
    const keys = [...figure.querySelectorAll(".legend li")];
    if (keys.length !== lines.length || lines.length < 2) return;
    const buttons = keys.map((key, i) => {
      const button = make("button", { type: "button", "aria-pressed": "true" }, ...key.childNodes);
      button.addEventListener("click", () => show(i, lines[i].hasAttribute("hidden")));
      key.append(button);
      return button;
    });

    function set(i, on) {
      lines[i].toggleAttribute("hidden", !on);
      buttons[i].setAttribute("aria-pressed", String(on));
    }

    function show(i, on) {
      set(i, on);
      asked.fill();
    }

    const groups = [...new Set(lines.map((line) => line.dataset.group))];
    if (groups.length < 2 || groups.length === lines.length) return;
    const select = only(groups, (group) => {
      lines.forEach((line, i) => set(i, !group || line.dataset.group === group));
      asked.fill();
    });
    figure.querySelector(".legend").before(select);
  }

  /** A list of names, of which one alone can be shown. */
  function only(names, change) {
    const select = make("select", {}, make("option", { value: "" }, "all"), ...names.map((name) => make("option", { value: name }, name)));
    select.addEventListener("input", () => change(select.value));
    return make("p", {}, make("label", {}, "Show only ", select));
  }

  function map(figure) {
    const svg = figure.querySelector("svg");
    const squares = [...svg.querySelectorAll("rect")].map((square) => ({
      x: Number(square.getAttribute("x")) + Number(square.getAttribute("width")) / 2,
      y: Number(square.getAttribute("y")) + Number(square.getAttribute("height")) / 2,
      words: square.textContent.trim(),
    }));
    const column = squares.filter((square) => square.x === squares[0]?.x).length;
    figure.append(pointer(svg, figure.querySelector("figcaption").textContent, () => squares, column).parts);
  }

  document.querySelectorAll("figure.chart").forEach(chart);
  document.querySelectorAll(".maps").forEach((maps) => {
    const figures = [...maps.querySelectorAll("figure")];
    figures.forEach(map);
    const engines = [...new Set(figures.map((figure) => figure.dataset.group))];
    if (engines.length > 1) maps.before(only(engines, (name) => figures.forEach((figure) => { figure.hidden = Boolean(name) && figure.dataset.group !== name; })));
  });
})();
