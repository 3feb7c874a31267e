"use strict";
// Errors over time on a logarithmic axis, and the motion of theory and engine, one over the other. A slider moves through
// time: by mouse, by touch and by the arrow keys; what it stands at is said in words.
const furikoMotion = (() => {
  const SIZE = 300, MARGIN = 14;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const said = (error) => (error === null || error === undefined ? "–" : `${error.toExponential(1).replace("e+", "e")} rad`);

  /** The joints of a mechanism [m], z upwards, from the support: legs hang from the first rod's end, a rod from the last. */
  function joints(angles, motion) {
    const found = [[0, 0]];
    angles.forEach((angle, k) => {
      const [x, z] = motion.fan && k ? found[1] : found.at(-1);
      found.push([x + motion.lengths[k] * Math.sin(angle), z - motion.lengths[k] * Math.cos(angle)]);
    });
    return found;
  }

  /** Angles between two frames. */
  function between(rows, at) {
    const k = Math.min(Math.floor(at), rows.length - 1), part = at - k;
    const next = rows[Math.min(k + 1, rows.length - 1)];
    return rows[k].map((angle, i) => angle + part * (next[i] - angle));
  }

  function scene(motion, svg) {
    const reach = motion.fan ? motion.lengths[0] + Math.max(0, ...motion.lengths.slice(1)) : motion.lengths.reduce((a, b) => a + b, 0);
    const scale = (SIZE / 2 - MARGIN) / (reach || 1);
    const place = ([x, z]) => `${(SIZE / 2 + scale * x).toFixed(1)} ${(SIZE / 2 - scale * z).toFixed(1)}`;
    const links = (angles) => {
      const all = joints(angles, motion).map(place);
      return motion.fan ? `M${all[0]}L${all[1]}${all.slice(2).map((end) => `M${all[1]}L${end}`).join("")}` : `M${all.join("L")}`;
    };
    const kinds = ["theory", "engine"].map((name) => ({
      name,
      trace: svg("path", { class: `trace ${name}`, d: `M${motion[name].map((angles) => place(joints(angles, motion).at(-1))).join("L")}` }),
      body: svg("path", { class: `body ${name}` }),
    }));
    const picture = svg("svg", { class: "motion", viewBox: `0 0 ${SIZE} ${SIZE}`, role: "img", "aria-label": "Theory and engine in motion, with the paths of the last joint" },
      svg("path", { class: "support", d: `M${SIZE / 2 - 12} ${SIZE / 2 - 3}h24` }), ...kinds.map((kind) => kind.trace), ...kinds.map((kind) => kind.body).reverse()); // theory, which is dashed, over the engine
    const show = (at) => kinds.forEach((kind) => kind.body.setAttribute("d", links(between(motion[kind.name], at))));
    return { picture, show };
  }

  function plot(errors, box) {
    const faint = colour("--faint"), line = colour("--line");
    const axis = { stroke: faint, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 } };
    const powers = (low, high) => {
      const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
      const every = Math.max(1, Math.ceil((last - first) / 8));
      return Array.from({ length: Math.max(0, Math.floor((last - first) / every) + 1) }, (_, i) => 10 ** (first + i * every));
    };
    return new uPlot({
      width: Math.max(240, Math.min(box.clientWidth || 560, 720)), height: 260,
      scales: { x: { time: false }, y: { distr: 3, log: 10 } },
      legend: { show: false }, cursor: { y: false, drag: { x: false, y: false }, points: { size: 8 } },
      series: [{}, { label: "measured", stroke: colour("--e0"), width: 2.5, spanGaps: false },
        { label: "predicted", stroke: colour("--e1"), width: 2, dash: [6, 4], spanGaps: false }],
      axes: [{ ...axis, label: "time [s]" }, { ...axis, label: "error of the angles [rad]", size: 62, splits: (_, axis, low, high) => powers(low, high), filter: (_, ticks) => ticks,
        values: (_, ticks) => ticks.map((tick) => `1e${Math.round(Math.log10(tick))}`) }],
    }, [errors[0], errors[2], errors[1]], box);
  }

  return function show(history, make, svg) {
    const [times, predicted, measured] = history.errors;
    const end = history.motion ? history.motion.times.at(-1) : times.at(-1);
    const box = make("div", { class: "uplot-box" });
    const now = make("output", {});
    const slider = make("input", { type: "range", min: "0", max: "1000", value: "0", "aria-label": "time" });
    const moving = history.motion ? scene(history.motion, svg) : null;
    const play = moving ? make("button", { type: "button" }, "Play") : null;
    let chart = null, timer = 0, started = 0;

    function stand(time) {
      let k = times.findIndex((one) => one >= time);
      if (k < 0) k = times.length - 1;
      const words = `${time.toFixed(2)} s: predicted ${said(predicted[k])}, measured ${said(measured[k])}`;
      now.textContent = words;
      slider.setAttribute("aria-valuetext", words);
      if (chart) chart.setCursor({ left: chart.valToPos(times[k], "x"), top: 10 }, false);
      if (moving) {
        const frames = history.motion.times;
        let next = frames.findIndex((one) => one > time);
        if (next < 0) next = frames.length;
        const before = Math.max(next - 1, 0), span = (frames[next] ?? frames[before]) - frames[before];
        moving.show(before + (span > 0 ? (time - frames[before]) / span : 0));
      }
    }

    const timeOf = () => (Number(slider.value) / 1000) * end;

    function stop() {
      cancelAnimationFrame(timer);
      timer = 0;
      if (play) play.textContent = "Play";
    }

    function step(clock) {
      if (!slider.isConnected) return stop();
      const time = (clock - started) / 1000;
      slider.value = String(Math.min(1000, (1000 * time) / end));
      stand(Math.min(time, end));
      if (time >= end) return stop();
      timer = requestAnimationFrame(step);
    }

    slider.addEventListener("input", () => { stop(); stand(timeOf()); });
    play?.addEventListener("click", () => {
      if (timer) return stop();
      if (Number(slider.value) >= 1000) slider.value = "0";
      started = performance.now() - 1000 * timeOf();
      play.textContent = "Pause";
      timer = requestAnimationFrame(step);
    });

    const legend = make("p", { class: "faint legend" },
      make("span", { class: "key measured" }, "measured"), make("span", { class: "key predicted" }, "predicted, from the local error of each step and the motion's tangent flow"));
    const drawn = moving ? make("p", { class: "faint legend" }, make("span", { class: "key measured" }, "engine"), make("span", { class: "key predicted" }, "theory")) : null;
    const part = make("div", { class: "motions" }, moving ? make("div", {}, moving.picture, drawn) : null, make("div", { class: "errors" }, box, legend));
    requestAnimationFrame(() => {
      if (box.isConnected && times.length > 1) chart = plot(history.errors, box);
      stand(timeOf());
    });
    return make("div", {}, part, make("div", { class: "player" }, play, slider, now));
  };
})();
