// Control of the camera by mouse, touch and keys.

/** Control a camera by mouse, touch and keys; a click or tap selects a position, Enter the centre. */
function steer(canvas, camera, moved, chosen) {
  const pointers = new Map();
  let went = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    if (pointers.size === 1) went = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.offsetX, event.offsetY];
    const [right, down] = now.map((place, k) => place - before[k]);
    const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    went += Math.hypot(right, down);
    if (others.length) {
      const [distance, previousDistance] = [now, before].map(([x, y]) => Math.hypot(x - others[0][0], y - others[0][1]));
      camera.closer(distance / Math.max(1, previousDistance));
      camera.shift(right / 2 / canvas.clientHeight, -down / 2 / canvas.clientHeight);
    } else if (event.buttons > 1 || event.shiftKey) {
      camera.shift(right / canvas.clientHeight, -down / canvas.clientHeight);
    } else {
      camera.turn(-right * 0.008, down * 0.008);
    }
    pointers.set(event.pointerId, now);
    moved();
  });
  canvas.addEventListener("pointerup", (event) => {
    if (pointers.size === 1 && went < 4 && event.button === 0) chosen(event.offsetX, event.offsetY);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return; // the page scrolls
    event.preventDefault();
    camera.closer(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
    moved();
  }, { passive: false });
  const shifted = {
    ArrowLeft: () => camera.shift(-0.05, 0),
    ArrowRight: () => camera.shift(0.05, 0),
    ArrowUp: () => camera.shift(0, 0.05),
    ArrowDown: () => camera.shift(0, -0.05),
  };
  const keys = {
    ArrowLeft: () => camera.turn(0.1, 0),
    ArrowRight: () => camera.turn(-0.1, 0),
    ArrowUp: () => camera.turn(0, -0.1),
    ArrowDown: () => camera.turn(0, 0.1),
    "+": () => camera.closer(1.15),
    "-": () => camera.closer(1 / 1.15),
    0: () => camera.reset(),
    c: () => camera.look("iso"),
    x: () => camera.look("x"),
    y: () => camera.look("y"),
    z: () => camera.look("z"),
    Enter: () => chosen(canvas.clientWidth / 2, canvas.clientHeight / 2),
  };
  canvas.addEventListener("keydown", (event) => {
    const act = (event.shiftKey && shifted[event.key]) || keys[event.key];
    if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    act();
    moved();
  });
}
