// Sent only by `site_builder serve`: reloads the page after a good build, shows the mistakes of
// a bad one over it.
const events = new EventSource("/.reload/events");
/** @type {string | null} */
let shown = null;

events.addEventListener("built", (event) => {
  if (shown !== null && shown !== event.data) location.reload();
  shown = event.data;
  document.getElementById("build-mistakes")?.remove();
});

events.addEventListener("failed", (event) => {
  document.getElementById("build-mistakes")?.remove();
  const report = document.createElement("pre");
  report.id = "build-mistakes";
  report.setAttribute("role", "alert");
  report.textContent = JSON.parse(event.data);
  report.style.cssText =
    "position:fixed;inset:auto 0 0 0;z-index:99;max-height:60vh;margin:0;padding:1rem 1.5rem;" +
    "overflow:auto;white-space:pre-wrap;font:14px/1.5 monospace;background:#3b0d0d;color:#fff";
  document.body.append(report);
});
