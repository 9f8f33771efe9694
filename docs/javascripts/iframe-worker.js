// The search of pages that are read from the disk, where a browser starts no worker of a file: a frame does its work.

class IFrameWorker extends EventTarget {
  /** @param {string} script The file that a worker would be of. */
  constructor(script) {
    super();
    const frame = document.createElement("iframe");
    frame.hidden = true;
    frame.srcdoc = "<!DOCTYPE html>"; // which is of the same origin as this page
    this.inside = new Promise((begun) => {
      frame.addEventListener("load", () => {
        const inside = frame.contentWindow;
        inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
        const program = inside.document.createElement("script");
        program.addEventListener("load", () => begun(inside));
        program.src = script;
        inside.document.body.append(program);
      }, { once: true });
    });
    document.documentElement.append(frame);
  }

  /** Tell the script inside, once it is there. */
  postMessage(data) {
    this.inside.then((inside) => inside.dispatchEvent(new inside.MessageEvent("message", { data })));
  }
}

if (location.protocol === "file:") window.Worker = IFrameWorker;
